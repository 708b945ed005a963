// Reads sheets of KES parameters, one fabric a row or one fabric a column.
// SPDX-License-Identifier: Apache-2.0
//
// No public description of a vendor's sheet exists; this reader goes by the headers (kes_header.h). Rules:
//   - units stand in the header or in a second header row; without them the quantity's KES unit is taken;
//   - 1 is the warp and 2 the weft in "B1", "B-2" (Kato's usage);
//   - bending and tensile columns without a direction count for both directions;
//   - shear and surface quantities given for both directions are averaged: the fabric model keeps one of
//   each.
// Each of these is noted in Fabric::warnings of every fabric it concerns. Two columns for the same number, an
// ambiguous header and an unknown unit are errors.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fuai/fabric/fabric.h"

namespace fuai {

/// Most fabrics in a sheet.
inline constexpr int kMostFabrics = 10000;

/// Reads a sheet: CSV with commas, tabs or semicolons, UTF-8 or CP932.
/// @return the fabrics in the order of the sheet, at least one [SI]
/// @throws Error (kBadInput) with line, column, key and cure: unreadable file, no header with a known
/// quantity, ambiguous header, unit of another dimension, a cell that is no number, an impossible number, a
/// fabric without mass. Thread class: set-up.
std::vector<Fabric> read_kes_sheet(const std::string& path);

/// The same from the text of a file (UTF-8, "\n"). @param name file name for messages and provenance
std::vector<Fabric> parse_kes_sheet(std::string_view text, const std::string& name);

}  // namespace fuai
