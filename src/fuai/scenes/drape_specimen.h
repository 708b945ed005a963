// The specimen of a drape tester: a round piece of cloth held by a smaller disc, with the small differences
// between one specimen and the next.
// SPDX-License-Identifier: Apache-2.0
// Source: BS 5058 and ISO 9073-9 (18 and 30 cm), JIS L 1096 (12.7 and 25.4 cm); docs/theory/drape.md.
#pragma once

#include <cstdint>
#include <numbers>

#include "fuai/cloth/cloth_model.h"
#include "fuai/cloth/cloth_piece.h"

namespace fuai {

/// Sizes [m]; the disc is the smaller one.
struct DrapeGeometry {
  double disc = 0.18;      ///< diameter of the disc that holds the cloth
  double specimen = 0.30;  ///< diameter of the cloth
  double spacing = 0.005;  ///< of the yarns of the lattice

  double overhang() const noexcept { return 0.5 * (specimen - disc); }
  /// Drape coefficient of a shadow of this area, the disc's included [-]. @param area [m2]
  double coefficient(double area) const noexcept {
    const double quarter_pi = 0.25 * std::numbers::pi;
    return (area - quarter_pi * disc * disc) / (quarter_pi * (specimen * specimen - disc * disc));
  }
};

/// Whether the lattice suits the sizes: the spacing at most a third of the overhang and a quarter of the
/// disc. Thread class: any.
bool fits(const DrapeGeometry& geometry) noexcept;

/// The tester of BS 5058 and ISO 9073-9, and that of JIS L 1096.
inline constexpr DrapeGeometry kCusickGeometry{0.18, 0.30, 0.005};
inline constexpr DrapeGeometry kJisGeometry{0.127, 0.254, 0.005};

/// What makes one specimen differ from the next.
struct DrapePerturbation {
  bool shift = true;       ///< the lattice lies anywhere against the specimen
  double density = 0.03;   ///< largest deviation of the areal mass [-]
  double velocity = 0.03;  ///< largest upward or downward speed at the start [m/s]
};

/// The specimen about (0, 0) without any unevenness, held by a sub-cell clamp within the disc. Sizes are not
/// checked. @param areal_mass [kg/m2]. Thread class: set-up.
ClothPieceSpec make_drape_spec(const DrapeGeometry& geometry, double areal_mass);

/// The specimen about (0, 0), held by a sub-cell clamp within the disc, with the cloth of its slots made
/// heavier and lighter by the perturbation of this seed (the total stays).
/// @param areal_mass [kg/m2]
/// @throws Error (kUsage) unless 0 < disc < specimen and the spacing fits(); as make_cloth_model(). Thread
/// class: set-up.
ClothModel make_drape_model(const DrapeGeometry& geometry, double areal_mass, std::uint64_t seed,
                            const DrapePerturbation& perturbation = {});

/// Flat, virgin, with the smooth velocities of this seed. Thread class: set-up.
ClothState make_drape_start(const DrapeGeometry& geometry, const ClothModel& model, std::uint64_t seed,
                            const DrapePerturbation& perturbation = {});

}  // namespace fuai
