// A measured fabric: the numbers and curves of one cloth with the provenance of each. No law, no lattice, no
// file.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fuai/core/types.h"
#include "fuai/fabric/measured_curve.h"
#include "fuai/fabric/provenance.h"

namespace fuai {

/// A measured curve together with its provenance.
struct KnownCurve {
  MeasuredCurve curve;
  Provenance provenance;
};

/// KES-FB2, one direction. With a curve, the scalars are its parameters; without, they stand alone.
struct BendingMeasurement {
  Known B;                          ///< bending rigidity per width [N m]
  Known hysteresis_2HB;             ///< full loop width of the moment per width [N]
  std::optional<KnownCurve> curve;  ///< moment per width against curvature
};

/// KES-FB1 shear.
struct ShearMeasurement {
  Known G;                ///< shear rigidity per width [N/(m rad)]
  Known hysteresis_2HG;   ///< loop width at 0.5 degrees [N/m]
  Known hysteresis_2HG5;  ///< loop width at 5 degrees [N/m]
  Known tension;  ///< constant tension of the test [N/m]; 0: the numbers are those of the shear stress
                  ///< itself, without a tension's share; unknown: see shear_test_of()
  std::optional<KnownCurve> curve;  ///< shear force per width against shear angle
};

/// KES-FB1 tensile, one direction.
struct TensileMeasurement {
  Known LT;         ///< linearity [-]
  Known WT;         ///< work of loading per area [J/m2]
  Known RT;         ///< resilience [fraction]
  Known EMT;        ///< strain at the largest load [fraction]
  Known peak_load;  ///< the load at which EMT was read, 500 gf/cm in the standard setting [N/m]
  std::optional<KnownCurve> curve;  ///< force per width against strain
};

/// KES-FB4.
struct SurfaceMeasurement {
  Known MIU, MMD;  ///< friction coefficient and its mean deviation [-]
  Known SMD;       ///< geometrical roughness [m]
};

/// KES-FB3.
struct CompressionMeasurement {
  Known LC;                         ///< linearity [-]
  Known WC;                         ///< work per area [J/m2]
  Known RC;                         ///< resilience [fraction]
  std::optional<KnownCurve> curve;  ///< pressure against thickness loss
};

/// Measured drape, kept for comparison only: nothing reads it to simulate.
struct DrapeMeasurement {
  Known drape_coefficient;  ///< [fraction]
  Known node_count;         ///< [-]
  Known disc_diameter;      ///< [m]
  Known specimen_diameter;  ///< [m]
};

/// How the yarns lie; it is looked at only, nothing reads it to simulate.
struct WeaveMeasurement {
  std::optional<WeaveStructure> structure;
  Known warp_threads;  ///< warp yarns per length of weft; of a knit its wales [1/m]
  Known weft_threads;  ///< weft yarns per length of warp; of a knit its courses [1/m]
};

/// One fabric. Everything is optional but a name and an areal mass.
struct Fabric {
  std::string id;           ///< file stem of a bundled fabric: "cupro-woven-su1098"
  std::string name;         ///< "Wool tropical"
  std::string composition;  ///< "100 % wool, plain weave"
  std::string note;         ///< what a user must know before trusting it

  Known areal_mass;                                         ///< W [kg/m2]
  Known thickness;                                          ///< T at 0.5 gf/cm2 [m]
  std::array<BendingMeasurement, kDirectionCount> bending;  ///< by Direction
  ShearMeasurement shear;
  std::array<TensileMeasurement, 2> tensile;  ///< warp, weft
  SurfaceMeasurement surface;
  CompressionMeasurement compression;
  DrapeMeasurement drape;
  WeaveMeasurement weave;

  std::vector<std::string> warnings;  ///< what a reader or fit found suspicious, in plain sentences
};

}  // namespace fuai
