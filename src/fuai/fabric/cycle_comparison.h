// A law driven through a recording, cycle by cycle: does it repeat loops it was not made from?
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "fuai/fabric/measured_curve.h"
#include "fuai/fabric/play_law.h"

namespace fuai {

/// How one cycle (a loading branch and what follows up to the next one) compares.
struct CycleMisfit {
  int cycle = 0;                     ///< from 0
  double peak_strain = 0.0;          ///< largest |strain| [unit of strain]
  double peak_stress = 0.0;          ///< largest |stress| measured [unit of stress]
  double rms_fraction = 0.0;         ///< rms of predicted minus measured, over peak_stress
  double max_fraction = 0.0;         ///< largest |predicted - measured|, over peak_stress
  double measured_loop_area = 0.0;   ///< closed integral of stress over strain: energy lost per area
  double predicted_loop_area = 0.0;  ///< the same of the law
};

/// Misfits and the prediction they come from.
struct CycleComparison {
  std::vector<CycleMisfit> cycles;
  MeasuredCurve predicted;  ///< the law's stress at every measured strain, same branches
};

/// Drives the law from the virgin state through all measured strains in order, memory kept.
/// @return one misfit a cycle, and the predicted curve. Thread class: set-up.
CycleComparison compare_cycles(const PlayLaw& law, const MeasuredCurve& curve);

/// rms distance of the stresses of a curve from those of another at the same samples, over the other's peak;
/// 0 when that is 0. @param curve the same branches with as many samples. Thread class: any.
double rms_over_peak(const MeasuredCurve& curve, const MeasuredCurve& reference) noexcept;

}  // namespace fuai
