// The KES parameters of a measured curve, each by its definition: slopes, loop widths, works.
// SPDX-License-Identifier: Apache-2.0
// Source: definitions of the KES-FB instruments; docs/theory/kes.md.
//
// Which part of a recording is used. The sense of motion of a branch, not its label, says what it is: on the
// positive side (face) a rising branch loads and a falling branch unloads; on the negative side (back) it is
// the other way round. A cycle of a side is a loading branch with the unloading branch that follows it, or,
// where none follows, the unloading branch before it. By default the last cycle that covers every abscissa
// the parameters need is used, so the first loading of virgin cloth drops out as soon as a later loop exists.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "fuai/fabric/measured_curve.h"

namespace fuai {

/// A parameter read at +x and at -x; NaN where the curve does not show it.
struct TwoSided {
  double face = std::numeric_limits<double>::quiet_NaN();  ///< at positive strain
  double back = std::numeric_limits<double>::quiet_NaN();  ///< at negative strain

  /// Mean of the sides that are known; NaN when none is.
  double mean() const;
};

/// Where the parameters are read. The defaults are those of the KES-FB instruments.
struct KesReading {
  double bending_width_curvature = 100.0;  ///< |curvature| at which 2HB is read [1/m]; some use 50
  int cycle = -1;  ///< cycle of each side, counted from 0; -1: the last one that covers what is needed
};

/// KES-FB2.
struct BendingParameters {
  TwoSided B;                        ///< slope of loading over |K| = 50..150 1/m, least squares [N m]
  TwoSided hysteresis_2HB;           ///< loop width at the reading curvature [N]
  std::vector<std::string> missing;  ///< what could not be computed and why, plain sentences
};

/// KES-FB1 shear.
struct ShearParameters {
  TwoSided G;                        ///< slope of loading over 0.5..2.5 degrees, least squares [N/(m rad)]
  TwoSided hysteresis_2HG;           ///< loop width at 0.5 degrees [N/m]
  TwoSided hysteresis_2HG5;          ///< loop width at 5 degrees [N/m]
  std::vector<std::string> missing;  ///< as above
};

/// KES-FB1 tensile.
struct TensileParameters {
  double LT = std::numeric_limits<double>::quiet_NaN();         ///< WT / (peak_load EMT / 2) [-]
  double WT = std::numeric_limits<double>::quiet_NaN();         ///< work of loading, 0 to EMT [J/m2]
  double RT = std::numeric_limits<double>::quiet_NaN();         ///< recovered work over WT [fraction]
  double EMT = std::numeric_limits<double>::quiet_NaN();        ///< strain at the peak load [-]
  double peak_load = std::numeric_limits<double>::quiet_NaN();  ///< largest load of the cycle [N/m]
  std::vector<std::string> missing;                             ///< as above
};

/// KES-FB3.
struct CompressionParameters {
  double LC = std::numeric_limits<double>::quiet_NaN();             ///< WC / (peak (T0 - Tm) / 2) [-]
  double WC = std::numeric_limits<double>::quiet_NaN();             ///< work of loading [J/m2]
  double RC = std::numeric_limits<double>::quiet_NaN();             ///< recovered work over WC [fraction]
  double T0 = std::numeric_limits<double>::quiet_NaN();             ///< thickness at no loss [m]
  double Tm = std::numeric_limits<double>::quiet_NaN();             ///< thickness at the peak pressure [m]
  double peak_pressure = std::numeric_limits<double>::quiet_NaN();  ///< [Pa]
  std::vector<std::string> missing;                                 ///< as above
};

/// B and 2HB of a moment-curvature recording.
/// @param curve bending curve [1/m, N]
/// @param reading where to read
/// @return both faces; NaN and a sentence in `missing` where the curve does not reach
/// Thread class: any. @source Kawabata 1980, KES-FB2
BendingParameters compute_bending_parameters(const MeasuredCurve& curve, const KesReading& reading = {});

/// G, 2HG, 2HG5 of a shear recording [rad, N/m]; as above. @source Kawabata 1980, KES-FB1
ShearParameters compute_shear_parameters(const MeasuredCurve& curve, const KesReading& reading = {});

/// LT, WT, RT, EMT of a tensile recording [-, N/m]. Works are trapezoidal sums over the samples: loading from
/// strain 0 to the peak load, recovery from the peak down to the first zero of the force.
/// Thread class: any. @source Kawabata 1980, KES-FB1
TensileParameters compute_tensile_parameters(const MeasuredCurve& curve, const KesReading& reading = {});

/// LC, WC, RC, Tm of a compression recording [m, Pa].
/// @param initial_thickness T0, thickness at zero loss [m]; NaN leaves T0 and Tm unknown
/// Thread class: any. @source Kawabata 1980, KES-FB3
CompressionParameters compute_compression_parameters(const MeasuredCurve& curve, double initial_thickness,
                                                     const KesReading& reading = {});

}  // namespace fuai
