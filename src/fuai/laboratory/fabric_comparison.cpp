// Compares fabrics.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/core/error.h"
#include "fuai/fabric/laws.h"

namespace fuai {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

bool comparable(const FabricNumber& a, const FabricNumber& b) {
  const auto stated = [](const FabricNumber& n) {
    return n.known.has_value() && n.setting_known && n.known.provenance.kind != ProvenanceKind::kAssumed;
  };
  return stated(a) && stated(b) && a.condition == b.condition;
}

void take_differences(ComparedNumber& number, std::span<const Threshold> thresholds) {
  const FabricNumber& first = number.first();
  if (const Threshold* found = find_threshold(thresholds, first.quantity)) number.threshold = *found;
  for (const FabricNumber& other : number.each) {
    const bool compared = comparable(first, other);
    const double from = first.known.value, to = other.known.value;
    number.change.push_back(compared && from != 0.0 ? (to - from) / from : kUnknown);
    number.jnd.push_back(compared && number.threshold ? just_noticeable_steps(*number.threshold, from, to)
                                                      : kUnknown);
  }
}

}  // namespace

double just_noticeable_steps(const Threshold& threshold, double from, double to) noexcept {
  if (threshold.kind == ThresholdKind::kDifference) return (to - from) / threshold.value;
  if (!(from > 0.0) || !(to > 0.0)) return kUnknown;
  return std::log(to / from) / std::log1p(threshold.value);
}

void check_compared_count(std::size_t count) {
  if (count >= kFewestCompared && count <= kMostCompared) return;
  throw Error(ErrorKind::kUsage, "a comparison needs two to six fabrics, not " + std::to_string(count), {},
              count < kFewestCompared ? "name another fabric" : "compare them in groups");
}

FabricComparison compare_fabrics(std::span<const Fabric> fabrics, std::span<const Threshold> thresholds) {
  check_compared_count(fabrics.size());
  FabricComparison comparison;
  comparison.fabrics.assign(fabrics.begin(), fabrics.end());
  comparison.thresholds.assign(thresholds.begin(), thresholds.end());
  std::vector<ComparedNumber> all;
  for (const Fabric& fabric : fabrics) {
    const std::vector<FabricNumber> own = fabric_numbers(fabric, make_fabric_laws(fabric));
    all.resize(own.size());
    for (std::size_t i = 0; i < own.size(); ++i) all[i].each.push_back(own[i]);
  }
  for (ComparedNumber& number : all) {
    if (std::ranges::none_of(number.each, [](const FabricNumber& n) { return n.known.has_value(); }))
      continue;
    take_differences(number, thresholds);
    comparison.numbers.push_back(std::move(number));
  }
  return comparison;
}

}  // namespace fuai
