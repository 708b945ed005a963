// Says in plain lines what was fitted to a Fabric Analyzer record.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/fabric/fab_fabric.h"

namespace fuai {

/// One line a fit with its residual, then every assumption; KES units. Thread class: set-up.
std::vector<std::string> describe(const FabFitReport& report);

}  // namespace fuai
