// Finds and loads the fabrics that come with fuai.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fuai/fabric/fabric.h"

namespace fuai {

/// The folder of bundled data, the first that exists of: the environment variable FUAI_DATA; share/fuai
/// beside the folder of the running program (as installed); data/ of the source tree it was built from.
/// @throws Error (kBadInput) when FUAI_DATA names no folder, or there is no data at all. Thread class:
/// set-up.
std::string data_folder();

/// Names of the bundled fabrics (data/fabrics/NAME.fabric.toml), sorted with numbers by value
/// (graded-3 before graded-10). @throws Error as data_folder().
/// Thread class: set-up.
std::vector<std::string> bundled_fabric_ids();

/// Loads a bundled fabric by its name, or a fabric file by its path (anything with a '/' or ending in
/// ".toml").
/// @throws Error (kBadInput): an unknown name, with the nearest bundled ones; see read_fabric_file(). Thread
/// class: set-up.
Fabric load_fabric(std::string_view name_or_path);

}  // namespace fuai
