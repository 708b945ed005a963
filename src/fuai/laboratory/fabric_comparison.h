// Two to six fabrics side by side, with their differences in percent and in just-noticeable differences.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/laboratory.md, "The fabric library".
//
// A difference is given between numbers that somebody measured (or computed from what was measured, or took
// from a statistic), at the same setting of the instrument. Assumed numbers stand in the table, but their
// differences would compare rules.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"
#include "fuai/io/threshold_file.h"
#include "fuai/laboratory/fabric_numbers.h"

namespace fuai {

inline constexpr int kFewestCompared = 2, kMostCompared = 6;

/// One quantity of all fabrics.
struct ComparedNumber {
  std::vector<FabricNumber> each;  ///< by fabric
  std::vector<double> change;      ///< (value - first) / first [-]; NaN: not comparable
  std::vector<double> jnd;         ///< just_noticeable_steps() from the first; NaN: not comparable, or no
                                   ///< threshold is known
  std::optional<Threshold> threshold;

  const FabricNumber& first() const { return each.front(); }
};

/// The outcome.
struct FabricComparison {
  std::vector<Fabric> fabrics;
  std::vector<ComparedNumber> numbers;  ///< quantities that at least one fabric has, in the order of the file
  std::vector<Threshold> thresholds;    ///< all that were offered, also those that are not used
};

/// How many times a hand's threshold lies between two values, negative downward: for a fraction w,
/// ln(to / from) / ln(1 + w), so that steps add up and there and back are the same; for a difference d,
/// (to - from) / d. NaN where a fraction meets a value that is not positive. Thread class: any.
/// @source Fechner 1860 (equal fractions are equal steps)
double just_noticeable_steps(const Threshold& threshold, double from, double to) noexcept;

/// Compares with the first fabric. @throws Error (kUsage) unless there are two to six; as make_fabric_laws().
/// Thread class: set-up.
FabricComparison compare_fabrics(std::span<const Fabric> fabrics, std::span<const Threshold> thresholds);

/// @throws Error (kUsage) unless so many fabrics can stand side by side; before anything is read or run.
void check_compared_count(std::size_t count);

}  // namespace fuai
