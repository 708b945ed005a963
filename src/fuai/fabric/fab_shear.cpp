// Solves the bias strip sample by sample.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/fab_shear.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "fuai/core/error.h"
#include "fuai/units/constants.h"

namespace fuai {

namespace {

constexpr int kYarnSamples = 400;
constexpr double kSlackNoise = 3.0;  // standard deviations: below, the strip is slack

/// Stress at x on the rising hull of a branch (running maximum), the last slope beyond its end.
double hull(const std::vector<CurveSample>& branch, double x) {
  if (x <= branch.front().strain) return 0.0;
  for (std::size_t i = 1; i < branch.size(); ++i) {
    const CurveSample &a = branch[i - 1], &b = branch[i];
    if (x <= b.strain) return a.stress + (b.stress - a.stress) * (x - a.strain) / (b.strain - a.strain);
  }
  const CurveSample &a = branch[branch.size() / 2], &b = branch.back();
  return b.stress + (b.stress - a.stress) / (b.strain - a.strain) * (x - b.strain);
}

/// The last branch of a kind, rising in both columns and starting at zero.
std::vector<CurveSample> rising_branch(const MeasuredCurve& curve, Branch kind) {
  const auto it = std::find_if(curve.branches.rbegin(), curve.branches.rend(),
                               [kind](const CurveBranch& b) { return b.kind == kind; });
  if (it == curve.branches.rend()) return {{0.0, 0.0}};
  std::vector<CurveSample> samples = it->samples;
  std::sort(samples.begin(), samples.end(),
            [](const CurveSample& a, const CurveSample& b) { return a.strain < b.strain; });
  std::vector<CurveSample> rising{{0.0, 0.0}};
  for (const CurveSample& s : samples) {
    if (s.strain > rising.back().strain) {
      rising.push_back({s.strain, std::max(s.stress, rising.back().stress)});
    }
  }
  return rising;
}

/// Sum of warp and weft on common strains, up to the larger peak.
std::vector<CurveSample> yarn_sum(const FabStretch& warp, const FabStretch& weft, Branch kind) {
  const std::vector<CurveSample> a = rising_branch(warp.curve, kind), b = rising_branch(weft.curve, kind);
  const double end = std::max(a.back().strain, b.back().strain);
  std::vector<CurveSample> sum{{0.0, 0.0}};
  for (int i = 1; i <= kYarnSamples && a.size() > 1 && b.size() > 1; ++i) {
    const double x = end * i / kYarnSamples;
    sum.push_back({x, hull(a, x) + hull(b, x)});
  }
  return sum;
}

/// An unloading branch stretched to begin at a turning point: resilience hardly depends on the amplitude.
std::vector<CurveSample> scaled(const std::vector<CurveSample>& unload, double strain, double load) {
  if (unload.size() < 2 || !(unload.back().stress > 0.0)) return {{0.0, 0.0}, {strain, load}};
  std::vector<CurveSample> result = unload;
  for (CurveSample& s : result) {
    s.strain *= strain / unload.back().strain;
    s.stress *= load / unload.back().stress;
  }
  return result;
}

/// Drops what the slack strip shows: before the load comes on, after it has gone.
void cut_slack(CurveBranch& branch, double threshold, bool virgin) {
  std::vector<CurveSample>& s = branch.samples;
  const auto taut = [threshold](const CurveSample& c) { return c.stress > threshold; };
  if (branch.kind == Branch::kUnload) {
    s.erase(std::find_if(s.rbegin(), s.rend(), taut).base(), s.end());
  } else if (!virgin) {
    s.erase(s.begin(), std::find_if(s.begin(), s.end(), taut));
  }
}

std::string describe(const FabShear& shear) {
  char text[240];
  const bool widens = shear.largest_lateral_stretch > 1.02;
  std::snprintf(text, sizeof text,
                "%s: homogeneous bias strip with hindered ends; yarns stretch by %.1f %%, angle uncertain by "
                "%.1f of %.1f degrees, force noise %.2f gf/cm%s",
                widens ? "poor" : "fair", 100.0 * shear.largest_yarn_strain,
                shear.angle_uncertainty / unit::kDegree, shear.largest_angle / unit::kDegree,
                shear.noise / unit::kGfPerCm,
                widens ? "; the model wants the strip to widen, so warp and weft are coupled (a knit)" : "");
  return text;
}

}  // namespace

BiasPoint solve_bias_point(double axial_stretch, double axial_load,
                           const std::vector<CurveSample>& yarn_load) {
  BiasPoint point;
  const double l1 = axial_stretch, P = std::max(axial_load, 0.0);
  // Bisection on T(eps) (1 + eps) - P l1, rising in eps.
  double low = 0.0, high = 1e-3;
  const auto excess = [&](double eps) { return hull(yarn_load, eps) * (1.0 + eps) - P * l1; };
  while (excess(high) < 0.0 && high < 10.0) high *= 2.0;
  for (int k = 0; k < 60 && P > 0.0; ++k) {
    const double mid = 0.5 * (low + high);
    (excess(mid) < 0.0 ? low : high) = mid;
  }
  point.yarn_strain = P > 0.0 ? 0.5 * (low + high) : 0.0;
  const double sum = 2.0 * (1.0 + point.yarn_strain) * (1.0 + point.yarn_strain);  // l1^2 + l2^2
  const double square = sum - l1 * l1;
  point.lateral_stretch = square > 0.0 ? std::sqrt(square) : std::numeric_limits<double>::quiet_NaN();
  point.angle = std::asin((l1 * l1 - square) / sum);
  point.stress = 0.5 * axial_load * point.lateral_stretch;
  return point;
}

FabShear make_fab_shear(const FabStretch& bias, const FabStretch& warp, const FabStretch& weft) {
  const std::vector<CurveSample> load = yarn_sum(warp, weft, Branch::kLoad);
  const std::vector<CurveSample> unload = yarn_sum(warp, weft, Branch::kUnload);
  FabShear shear;
  shear.noise = 0.5 * bias.force_noise;  // tau = P l2 / 2 with l2 near 1
  shear.curve.test = Test::kShear;
  shear.curve.direction = Direction::kBias;
  shear.curve.source = bias.curve.source;
  double turning_strain = 0.0, turning_load = 0.0;  // of the yarns, at the end of the last loading branch
  for (std::size_t k = 0; k < bias.curve.branches.size(); ++k) {
    CurveBranch branch{bias.curve.branches[k].kind, {}};
    const bool unloads = branch.kind == Branch::kUnload && turning_load > 0.0;
    const std::vector<CurveSample> yarn = unloads ? scaled(unload, turning_strain, turning_load) : load;
    for (const CurveSample& s : bias.curve.branches[k].samples) {
      const BiasPoint p = solve_bias_point(1.0 + s.strain, s.stress, yarn);
      if (std::isnan(p.lateral_stretch)) {
        throw Error(ErrorKind::kBadInput, "the bias strip is longer than its yarns allow",
                    {bias.curve.source, 0, 0, "raw_data"}, "check the free length of the bias strip");
      }
      branch.samples.push_back({p.angle, p.stress});
      shear.largest_yarn_strain = std::max(shear.largest_yarn_strain, p.yarn_strain);
      shear.largest_lateral_stretch = std::max(shear.largest_lateral_stretch, p.lateral_stretch);
      if (p.angle > shear.largest_angle) {
        shear.largest_angle = p.angle;
        shear.angle_uncertainty =
            unload.size() > 1 ? std::abs(solve_bias_point(1.0 + s.strain, s.stress, unload).angle - p.angle)
                              : 0.0;
      }
    }
    if (branch.kind == Branch::kLoad) {
      const CurveSample& s = bias.curve.branches[k].samples.back();
      turning_strain = solve_bias_point(1.0 + s.strain, s.stress, load).yarn_strain;
      turning_load = hull(load, turning_strain);
    }
    cut_slack(branch, kSlackNoise * shear.noise, k == 0);
    if (branch.samples.size() >= 2) shear.curve.branches.push_back(std::move(branch));
  }
  shear.quality = describe(shear);
  return shear;
}

}  // namespace fuai
