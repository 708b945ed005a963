// A fabric out of the raw tests of the Fabric Analyzer.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fuai/fabric/buckling_fit.h"
#include "fuai/fabric/fab_record.h"
#include "fuai/fabric/fab_shear.h"
#include "fuai/fabric/fab_stretch.h"
#include "fuai/fabric/fabric.h"

namespace fuai {

/// Every fit behind the fabric, for reports and plots.
struct FabFitReport {
  std::vector<BucklingFit> bending;         ///< one a direction that could be fitted
  std::vector<FabStretch> tensile;          ///< warp, weft
  std::vector<FabClampCheck> clamp_checks;  ///< one a direction that has both stretch tests
  std::optional<FabShear> shear;
  std::vector<std::string> assumptions;  ///< each a plain sentence
  std::vector<std::string> warnings;     ///< the same as in the fabric
};

/// Makes a fabric: areal mass and thickness as the file states them; B and 2HB fitted (buckling_fit.h);
/// tensile curves with LT, WT, RT, EMT of the last cycle at the load the machine reached; shear curve with G
/// of the first loading and lower bounds of 2HG and 2HG5 (fab_shear.h); a poor shear curve stays in the
/// report only. A test that is missing or cannot be used is left out with a warning. Compression is left out:
/// the area of the thickness head is not in the file.
/// @param record the file @param report filled with every fit when not null
/// @throws Error (kBadInput) when the file has no areal mass. Thread class: set-up.
Fabric make_fabric_from_fab(const FabRecord& record, FabFitReport* report = nullptr);

}  // namespace fuai
