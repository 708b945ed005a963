// Looks for branches of a measured curve that cross or move against their names.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include "fuai/io/curve_csv.h"
#include "fuai/io/number_text.h"

namespace fuai {
namespace {

/// Strains at which two branches are compared.
constexpr int kProbes = 50;

/// Stress of a branch at a strain, by linear interpolation on samples sorted by strain.
double stress_at(const std::vector<CurveSample>& sorted, double strain) {
  const auto above = std::lower_bound(sorted.begin(), sorted.end(), strain,
                                      [](const CurveSample& s, double x) { return s.strain < x; });
  if (above == sorted.begin()) return sorted.front().stress;
  if (above == sorted.end()) return sorted.back().stress;
  const CurveSample& a = *(above - 1);
  const double t = (strain - a.strain) / (above->strain - a.strain);
  return a.stress + t * (above->stress - a.stress);
}

std::vector<CurveSample> sorted_by_strain(const CurveBranch& branch) {
  std::vector<CurveSample> samples = branch.samples;
  std::stable_sort(samples.begin(), samples.end(), [](auto a, auto b) { return a.strain < b.strain; });
  return samples;
}

/// Fraction of the common strains at which the way back lies on the wrong side of the way out; nothing when
/// the two branches have no strain in common.
std::optional<double> crossed_fraction(const CurveBranch& out, const CurveBranch& back) {
  const std::vector<CurveSample> a = sorted_by_strain(out), b = sorted_by_strain(back);
  const double low = std::max(a.front().strain, b.front().strain);
  const double high = std::min(a.back().strain, b.back().strain);
  if (!(low < high)) return std::nullopt;
  const double sense = out.samples.back().strain >= out.samples.front().strain ? 1.0 : -1.0;
  double largest = 0.0;
  for (const CurveSample& s : a) largest = std::max(largest, std::abs(s.stress));
  int crossed = 0;
  for (int i = 1; i <= kProbes; ++i) {
    const double strain = low + (high - low) * i / (kProbes + 1);
    // A millionth of the peak: branches that lie on each other are an elastic cloth, not crossed.
    if (sense * (stress_at(b, strain) - stress_at(a, strain)) > 1e-6 * largest) ++crossed;
  }
  return static_cast<double>(crossed) / kProbes;
}

/// Whether a branch moves against its name: a load that ends nearer to zero strain than it began, an unload
/// that ends farther, by more than half of the strain it covers (a branch may overrun zero a little).
bool moves_against_its_name(const CurveBranch& branch) {
  const double begin = branch.samples.front().strain, end = branch.samples.back().strain;
  const double outwards = std::abs(end) - std::abs(begin);
  return (branch.kind == Branch::kLoad ? -outwards : outwards) > 0.5 * std::abs(end - begin);
}

}  // namespace

std::vector<std::string> curve_warnings(const MeasuredCurve& curve) {
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < curve.branches.size(); ++i) {
    if (!moves_against_its_name(curve.branches[i])) continue;
    const bool load = curve.branches[i].kind == Branch::kLoad;
    warnings.push_back(curve.source + ": branch " + std::to_string(i + 1) + " is called " +
                       (load ? "load but moves towards" : "unload but moves away from") +
                       " zero strain; check whether load and unload are swapped");
  }
  for (std::size_t i = 0; i + 1 < curve.branches.size(); ++i) {
    if (curve.branches[i].kind != Branch::kLoad) continue;
    const std::optional<double> fraction = crossed_fraction(curve.branches[i], curve.branches[i + 1]);
    if (!fraction || *fraction <= 0.5) continue;
    warnings.push_back(
        curve.source + ": the branches cross: unloading branch " + std::to_string(i + 2) +
        " lies above the loading branch before it over " + brief_number(100.0 * *fraction) +
        " % of their common strains, as if the cloth gave back more work than it took; check " +
        "whether load and unload are swapped");
  }
  return warnings;
}

}  // namespace fuai
