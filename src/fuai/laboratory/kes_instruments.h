// The virtual instruments KES-FB1 (tension, shear) and KES-FB2 (bending): a specimen of cloth, clamped, moved
// and stopped as in the real ones, and the curve that they record.
// SPDX-License-Identifier: Apache-2.0
// Source: Kawabata 1980 (instruments); docs/theory/virtual-kes.md.
//
//   instrument  specimen            motion                                            stops
//   bending     20 cm x 1 cm        moving clamp turned, free of force in its plane   +2.5, -2.5, 0 1/cm
//   shear       20 cm x 5 cm        moving clamp shifted under constant tension       +8, -8, 0 degrees
//   tension     20 cm x 5 cm        moving clamp pulled                               500 gf/cm, 0
//
// The friction memory moves after every step; nothing has a time.
#pragma once

#include <vector>

#include "fuai/core/progress.h"
#include "fuai/fabric/laws.h"
#include "fuai/fabric/shear_test.h"
#include "fuai/laboratory/kes_drive.h"

namespace fuai {

/// How a test is done; zeros mean the instrument's own.
struct KesOptions {
  Direction direction = Direction::kWarp;  ///< yarns from clamp to clamp: warp or weft
  double high = 0.0;  ///< stop: curvature [1/m], angle [rad], or load [N/m] (0: 2.5 1/cm, 8 deg, 500 gf/cm)
  double low = 0.0;   ///< second stop of bending and shear, not above zero; used when `high` is given
  double stop_strain = 0.0;  ///< tension: turn back at this strain instead of at a load [-]; 0: at the load
  double spacing = 0.0;      ///< h [m] (0: 2 mm in bending, 5 mm in shear, 1 cm in tension)
  double width = 0.2;        ///< of the specimen [m]
  double length = 0.05;      ///< between the clamps, of a tensile specimen [m]
  double tension = kKesShearTension;  ///< of the shear test [N/m]
  bool stress = false;  ///< shear: record the stress that the cloth carries instead of the force, that is
                        ///< (F - W0 tan(phi)) d / L with d the distance of the clamps
  bool conditioned = false;  ///< one cycle of bending or shear before the recorded one, for laws that were
                             ///< made from a steady loop and know nothing of virgin cloth
  std::vector<KesReversal> reversals;  ///< on the way to the first stop; tension: `back` 0 is no load
};

/// What was recorded.
struct KesRecord {
  MeasuredCurve curve;      ///< branches split at zero and at every turn
  double stretch = 1.0;     ///< shear: of the tensioned yarns, at the end (angle zero) [-]
  double edge_share = 0.0;  ///< shear: by how much the specimen with its free edges carries less per width,
                            ///< at the first stop [-]
  double spacing = 0.0;     ///< that was used [m]
  int iterations = 0;       ///< Newton's, all together
};

/// Curvature [1/m] and moment per width [N]. The moment is that on the moving clamp, which is free of force:
/// the specimen is in pure bending, the same moment everywhere.
/// @throws Error (kUsage) for options that make no test, (kCheckFailed) when the cloth does not come to rest.
/// Thread class: set-up.
KesRecord run_kes_bending(const FabricLaws& laws, const KesOptions& options, const Progress& progress = {});

/// Angle [rad], of the tensioned yarns against the normal of the clamps, and force per width [N/m] with the
/// share of the tension in it (shear_test.h). At its free edges the shear stress of a specimen runs out,
/// which belongs to the specimen and not to the cloth: a second one of twice the width is sheared alike, and
/// what is recorded is the difference of the forces over that of the widths. `edge_share` says what that
/// makes. Errors and thread class as above.
KesRecord run_kes_shear(const FabricLaws& laws, const KesOptions& options, const Progress& progress = {});

/// Strain [-] and force per width [N/m], up to exactly the stop and back to exactly no load; its width keeps
/// the specimen from narrowing. Errors and thread class as above.
KesRecord run_kes_tensile(const FabricLaws& laws, const KesOptions& options, const Progress& progress = {});

}  // namespace fuai
