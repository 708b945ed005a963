// Reads and writes measured curves as CSV files (fuai-curve/1).
// SPDX-License-Identifier: Apache-2.0
//
//   # fuai-curve/1 test=bending direction=warp
//   curvature_per_cm,moment_gf_cm_per_cm,branch
//   0,0.0125,load
//
// The writer makes exactly this. The reader also takes tabs, semicolons, decimal commas and CP932; any unit
// that the header states, as a suffix or in brackets ("曲率 (1/cm)", "moment [cN·cm/cm]"); title lines above
// the header and further columns, which it does not read; and files without the first line when the caller
// names the test.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/fabric/measured_curve.h"

namespace fuai {

/// What the caller knows of a curve. When the file states it too, both must agree.
struct CurveCsvOptions {
  std::optional<Test> test;
  std::optional<Direction> direction;
};

/// Reads a curve file. Samples keep their order; a new branch begins where the `branch` column changes.
/// Without that column the recording is split at the turning points of the strain (a reversal counts when it
/// exceeds 1 % of the strain range); the turning sample then belongs to both branches, and the first branch
/// is `load` unless the strain moves towards zero on it.
/// @return the curve [SI]
/// @throws Error (kBadInput) with line, column and key: unreadable file, unknown test, missing or ambiguous
/// column, missing or wrong unit, a cell that is no finite number, a branch of one sample, a strain that
/// never changes, a stress that falls while the strain grows over the whole recording. Thread class: set-up.
MeasuredCurve read_curve_csv(const std::string& path, const CurveCsvOptions& options = {});

/// The same from the text of a file (UTF-8, "\n"). @param name file name for messages and
/// MeasuredCurve::source
MeasuredCurve parse_curve_csv(std::string_view text, const std::string& name,
                              const CurveCsvOptions& options = {});

/// The text of a curve file; parse_curve_csv() brings back every sample (exactly those that were read from a
/// file, any other within two units in the last place). Thread class: set-up.
std::string format_curve_csv(const MeasuredCurve& curve);

/// Writes a curve file whole or not at all. @throws Error (kBadInput), see write_atomically(). Thread class:
/// set-up.
void write_curve_csv(const std::string& path, const MeasuredCurve& curve);

/// What looks wrong in a curve although it can be read, in plain sentences: branches that cross, that is an
/// unloading branch above the loading branch before it over more than half of their common strains (the cloth
/// would give back more work than was done on it), and branches that move against their names (a load
/// towards zero strain, an unload away from it). Thread class: set-up.
std::vector<std::string> curve_warnings(const MeasuredCurve& curve);

}  // namespace fuai
