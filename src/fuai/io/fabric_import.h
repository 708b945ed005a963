// Measurements as laboratories have them -> fabrics: what a file is shows in its name and first bytes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"
#include "fuai/io/curve_csv.h"

namespace fuai {

/// What is to be read.
struct FabricImport {
  std::vector<std::string> files;  ///< one, or the curve files of one fabric
  CurveCsvOptions curves;  ///< of curve files that do not say what they are; a test in it makes a file one
  std::string name;        ///< of a fabric made of curve files
  bool has_mass = false;   ///< the caller knows what the fabric weighs: curve files do not
};

/// What was read.
struct ImportedFabrics {
  std::string kind;  ///< "a KES sheet"
  std::vector<Fabric> fabrics;
  std::vector<std::string> fits;  ///< a line about each fit of a physics file
};

/// U3M/FAB physics JSON, a fabric file, curve files or a KES sheet, which may hold several fabrics.
/// @throws Error (kBadInput) as the readers; (kUsage) for several files that are not all curves, and for
/// curve files without a mass. Thread class: set-up.
ImportedFabrics import_fabrics(const FabricImport& import);

/// Whether a file says that it is a measured curve (fuai-curve/1). @throws Error (kBadInput) when it cannot
/// be read. Thread class: set-up.
bool is_curve_file(const std::string& path);

/// Puts the curve of a file in the place of what the fabric knows of this test and direction, KES parameters
/// included. @throws Error (kBadInput) as read_curve_csv() and add_measured_curve(). Thread class: set-up.
void replace_by_curve(Fabric& fabric, const std::string& path);

}  // namespace fuai
