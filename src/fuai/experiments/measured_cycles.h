// The laws of the bundled FAB fabrics against their own measured nested cycles.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/fabric/cycle_comparison.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// One curve of nested cycles beside its law.
struct MeasuredCycles {
  std::string fabric_id, fabric_name;
  std::string law;      ///< "tensile.warp", "shear"
  MeasuredCurve curve;  ///< as measured
  CycleComparison comparison;
};

/// Every bundled tensile and shear curve with more than one cycle. @throws Error as load_fabric(). Thread
/// class: set-up.
std::vector<MeasuredCycles> compare_all_measured_cycles();

/// Points measured, lines predicted, in KES units.
Plot measured_cycles_plot(const MeasuredCycles& cycles);

}  // namespace fuai
