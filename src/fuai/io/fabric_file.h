// Reads and writes fabric files (*.fabric.toml, fuai-fabric/1).
// SPDX-License-Identifier: Apache-2.0
//
// Besides the keys of units/kes.h a file may hold: `note` at the top; `peak_load_gf_per_cm` in [tensile.*]
// (default 500); `tension_gf_per_cm` in [shear] (default 10, or 0 with a curve in bias direction);
// `node_count`, `disc_cm` and `specimen_cm` in [drape]; `curve = "file.csv"` in [bending.*], [shear],
// [tensile.*] and [compression], a path relative to the file that stays below its folder. [provenance] names
// a block or a key, quoted: "bending", "bending.warp", "bending.warp.B_gf_cm2_per_cm", "bending.warp.curve";
// the most specific entry wins; each is { kind = "measured", source = "...", quality =
// "..." }, quality optional.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/fabric/fabric.h"

namespace fuai {

/// Largest fabric file that is read [bytes]; curves are files of their own.
inline constexpr std::uint64_t kLargestFabricFile = 1024ULL * 1024;

/// Reads a fabric file and the curve files beside it. What can be used but looks wrong becomes a sentence in
/// Fabric::warnings: a value outside the range of real cloth, a WT that disagrees with LT and EMT, crossed
/// branches, a number without provenance (which gets kind measured and says so).
/// @return the fabric [SI]; id is the file name without ".fabric.toml"
/// @throws Error (kBadInput) with file, line, column, key and cure: unreadable or broken file, another
/// format, unknown key (with the nearest known one), wrong type, missing name or mass, impossible number,
/// curve file missing or wrong. Thread class: set-up.
Fabric read_fabric_file(const std::string& path);

/// The same from the text of a file (UTF-8, "\n").
/// @param name file name for messages and for the id. @param folder where curve files are looked for
Fabric parse_fabric(std::string_view text, const std::string& name, const std::string& folder);

/// The text of a fabric file. Curves are named "<stem>.bending.warp.csv" and so on, as write_fabric_file()
/// writes them. Reading it back gives the same fabric, but for the warnings, which the reader finds anew.
/// @param stem beginning of the names of curve files; the fabric's id when empty
/// @throws Error (kBadInput) when the fabric has no name, no mass or an impossible number. Thread class:
/// set-up.
std::string format_fabric(const Fabric& fabric, const std::string& stem = {});

/// The files that write_fabric_file() writes: the curve files, then the fabric file. Thread class: set-up.
std::vector<std::string> fabric_file_paths(const std::string& path, const Fabric& fabric);

/// Writes the file and its curve files together, the fabric file last.
/// @throws Error (kBadInput), see format_fabric() and write_together(). Thread class: set-up.
void write_fabric_file(const std::string& path, const Fabric& fabric);

/// "wool" of "data/wool.fabric.toml": file name without folder, ".toml" and ".fabric". Thread class: any.
std::string fabric_id_of(const std::string& path);

}  // namespace fuai
