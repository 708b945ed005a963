// Reads the raw tests of a U3M 1.1 physics file (Browzwear Fabric Analyzer).
// SPDX-License-Identifier: Apache-2.0
// Source: physics_schema.json of github.com/vizoogmbh/u3m; "Raw Measurement Data from FAB" 1.2, Browzwear
// 2020.
#pragma once

#include <string>
#include <string_view>

#include "fuai/fabric/fab_record.h"

namespace fuai {

/// Reads a physics file: all strips of `raw_data` with any number of branches, the thickness test, the mass,
/// and the name, composition, category and thickness that `custom.browzwear` states. Distances come in cm,
/// forces in gf; numbers may be written as strings. The vendor's own stiffness numbers are not read: their
/// units are not published.
/// @return the record [SI]
/// @throws Error (kBadInput) with the line and column of a JSON mistake, or the key of a wrong value
/// ("raw_data.L .S1.width"); also for a file that cannot be read. Thread class: set-up.
FabRecord read_u3m_physics(const std::string& path);

/// The same from the text of a file. @param name file name for messages and FabRecord::source.
FabRecord parse_u3m_physics(std::string_view text, const std::string& name);

}  // namespace fuai
