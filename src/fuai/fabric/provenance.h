// Where a number comes from. Every number of a fabric carries one.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <string>
#include <string_view>

namespace fuai {

/// How much a number can be trusted, best first.
enum class ProvenanceKind {
  kMeasured,   ///< read off an instrument, or published as measured
  kComputed,   ///< follows from a measured curve by its definition
  kFitted,     ///< parameter of a model fitted to measurements; has a residual
  kStatistic,  ///< a quantile or mean over many fabrics, not this one
  kAssumed,    ///< a documented rule; nobody measured it
};

constexpr const char* to_string(ProvenanceKind kind) {
  constexpr const char* kNames[] = {"measured", "computed", "fitted", "statistic", "assumed"};
  return kNames[static_cast<int>(kind)];
}

/// Kind and source of a number.
struct Provenance {
  ProvenanceKind kind = ProvenanceKind::kMeasured;
  std::string source;   ///< who, where, how; for kAssumed the rule
  std::string quality;  ///< empty, or a warning such as "low-force: residual 31 % of the peak"
};

/// A number of a fabric [SI] and where it comes from; NaN means "not known".
struct Known {
  double value = std::numeric_limits<double>::quiet_NaN();
  Provenance provenance;

  bool has_value() const { return !std::isnan(value); }
};

}  // namespace fuai
