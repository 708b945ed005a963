// The curvature of three consecutive particles of a thread, in the forms of Eq. (2), with full gradients.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", Eq. (2).
//
//        P           a, b   unit vectors from M to P and to R
//         \ theta    theta  angle PMR in [0, pi]; flat: pi
//          M---R     l      rest distance of neighbouring particles
//
//   circle through the three points:  K = (2/l) cos(theta/2) = |a + b| / l      for theta > pi/4        (2a)
//   sharper folds:  K = (pi/4)^2 beta / theta + alpha - (pi/4) beta             for theta <= pi/4       (2b)
//   alpha = (2/l) cos(pi/8), beta = (1/l) sin(pi/8): value and slope go on at pi/4, K -> infinity at theta =
//   0
//
// The paper prints 2/l cos(theta) for (2a), which is -2/l for flat cloth and does not meet alpha, and
// -(pi/4) beta / theta + alpha + (pi/4) beta for (2b), which jumps at pi/4 and falls to minus infinity.
// It also calls l the distance of P and R; with that chord the curvature of a circle comes out at 0.50 to
// 0.57.
#pragma once

#include "fuai/core/types.h"

namespace fuai {

/// How folds sharper than pi/4 are continued.
enum class CurvatureForm {
  kC1,       ///< Eq. (2b): same value and slope at pi/4
  kPrinted,  ///< as printed, with its jump
};

/// K and dK/dtheta.
struct CurvatureOfAngle {
  double curvature = 0.0;  ///< [1/m], >= 0 but for kPrinted
  double slope = 0.0;      ///< [1/m/rad]
};

/// Curvature of an angle.
/// @param theta angle PMR [rad] in [0, pi]; below kSmallestAngle it is taken as that
/// @param leg distance l of neighbouring particles [m]
/// Thread class: real-time.
/// @source Wada et al., Eq. (2), corrected as above
CurvatureOfAngle curvature_of_angle(double theta, double leg, CurvatureForm form) noexcept;

/// The first line of Eq. (2) letter by letter, (2/l) cos(theta) [1/m]: no curvature (see above), kept as a
/// record of what is printed. Thread class: real-time.
double curvature_literal_cosine(double theta, double leg) noexcept;

/// Angles below this count as this [rad], so that a closed fold has a finite force.
inline constexpr double kSmallestAngle = 1e-3;
/// |a + b| below this counts as flat: there the sheet's normal gives the direction of the gradient.
inline constexpr double kFlatSum = 1e-12;

/// |weft x warp tangent| below this counts as parallel: no normal, no friction, no face (tangents have length
/// 2).
inline constexpr double kParallelTangents = 1e-6;

/// Signed curvature and its gradients; the gradient at M is -(gradient_p + gradient_r).
struct TripleCurvature {
  double curvature = 0.0;          ///< [1/m], positive when the centre of curvature lies on the normal's side
  Vec3 gradient_p = Vec3::Zero();  ///< dK/dP [1/m2]
  Vec3 gradient_r = Vec3::Zero();  ///< dK/dR [1/m2]
};

/// Curvature of P, M, R with the sign of (a + b) . normal, and its gradients for a fixed sign:
/// dK/dP = (e - (e.a) a) / (l |P-M|), e = sign (a + b) / |a + b|, which is regular at theta = pi; in flat
/// cloth e is the normal. @param rest_leg l [m] @param normal an oriented normal at M, any length; zero
/// counts as the positive side. Thread class: real-time.
/// @source Wada et al., Eq. (2)
TripleCurvature evaluate_curvature(const Vec3& p, const Vec3& m, const Vec3& r, double rest_leg,
                                   const Vec3& normal, CurvatureForm form) noexcept;

/// Curvature as a vector, seen from the sheet. With memory a moment need not vanish where |a + b| does, and
/// sign |a + b| has a crease there; the component along the normal has none.
///   k = K e / |e|, e = a + b    normal curvature kappa = k . n, n = N / |N|, N = weft x warp tangent
struct NormalCurvature {
  Vec3 vector = Vec3::Zero();    ///< k [1/m]
  Vec3 normal = Vec3::Zero();    ///< n; zero where the tangents are parallel
  double curvature = 0.0;        ///< kappa [1/m]
  double in_plane_square = 0.0;  ///< |k|^2 - kappa^2 [1/m2]: the thread bends within the sheet
};

/// The three nodes of a triple and the frame of the sheet at the middle one.
struct CurvatureStencil {
  Vec3 p, m, r;                     ///< positions [m]
  Vec3 weft_tangent, warp_tangent;  ///< sums of the unit vectors of the edges at M, toward growing index [-]
  double rest_leg = 1.0;            ///< l [m]
};

/// Thread class: real-time.
NormalCurvature evaluate_normal_curvature(const CurvatureStencil& stencil) noexcept;

/// Gradient of E(kappa, k) = W(kappa) + B/2 (|k|^2 - kappa^2), for W' = moment.
struct NormalCurvatureGradient {
  Vec3 p = Vec3::Zero(), r = Vec3::Zero();  ///< dE/dP and dE/dR through k; at M: the opposite of their sum
  Vec3 weft_tangent = Vec3::Zero(), warp_tangent = Vec3::Zero();  ///< dE/d tangents, through n
};

/// V = dE/dk = B k + c n with c = moment - B kappa; dE/de = f V / l + f' (e.V) e / (|e| l) with k = f e / l;
/// dE/dN = c (k - kappa n) / |N|. With W = B kappa^2 / 2 this is the gradient of B K^2 / 2.
/// @param moment W' [N] @param in_plane_stiffness B [N m]. Thread class: real-time.
NormalCurvatureGradient evaluate_normal_gradient(const CurvatureStencil& stencil, double moment,
                                                 double in_plane_stiffness) noexcept;

/// f = K l / |e| of the C1 form and its derivative by |e|: 1 and 0 on the circle.
struct FoldFactor {
  double value = 1.0, slope = 0.0;
};

/// @param sum |a + b| in [0, 2]. Thread class: real-time.
FoldFactor evaluate_fold_factor(double sum) noexcept;

}  // namespace fuai
