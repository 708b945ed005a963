// Identification of play laws from loops. The symbols are those of play_law.h.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/identify.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Below this share of the fully reversed friction the quotient I1 is noise over noise; Y is continued from
/// inside.
constexpr double kLeastDenominator = 1e-9;

void check_nodes(std::size_t a, std::size_t b, double low, double high) {
  if (a != b || a < 5) {
    throw Error(ErrorKind::kBadInput, "a loop needs at least five nodes and equally many on both branches");
  }
  if (!(low < high)) throw Error(ErrorKind::kBadInput, "a loop needs low < high");
}

void check_radii(std::span<const PlayElement> elements, double largest) {
  for (const PlayElement& e : elements) {
    if (e.radius > largest * (1.0 + 1e-12)) {
      throw Error(ErrorKind::kBadInput, "a play radius is larger than the loop can turn over", {},
                  "use radii of at most half the measured range");
    }
  }
}

/// What I1 and I2 give: elastic and friction values at the nodes.
struct ElasticAndFriction {
  std::vector<double> elastic, friction;
};

/// Solves F_e + Y S_a = a, F_e + Y S_b = b at every node. Where S_a = S_b (the turning points) Y is free and
/// is continued from the two nodes beside.
ElasticAndFriction split(std::span<const double> a, std::span<const double> b,
                         const std::function<double(std::size_t)>& S_a,
                         const std::function<double(std::size_t)>& S_b) {
  const std::size_t n = a.size();
  ElasticAndFriction result{std::vector<double>(n), std::vector<double>(n)};
  std::vector<bool> free(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double difference = S_a(i) - S_b(i);
    free[i] = difference < kLeastDenominator;
    result.friction[i] = free[i] ? 0.0 : std::max((a[i] - b[i]) / difference, 0.0);
  }
  for (std::size_t i : {std::size_t{0}, n - 1}) {
    if (!free[i]) continue;
    const std::size_t one = i == 0 ? 1 : n - 2, two = i == 0 ? 2 : n - 3;
    result.friction[i] = std::max(2.0 * result.friction[one] - result.friction[two], 0.0);
  }
  for (std::size_t i = 0; i < n; ++i) {
    // With crossed branches (Y = 0) the elastic curve is their mean; otherwise this equals a - Y S_a.
    result.elastic[i] = 0.5 * (a[i] + b[i] - result.friction[i] * (S_a(i) + S_b(i)));
  }
  return result;
}

ElasticAndFriction split_loop(const LoopNodes& nodes, std::span<const PlayElement> elements) {
  const double h = (nodes.high - nodes.low) / static_cast<double>(nodes.up.size() - 1);
  const std::size_t last = nodes.up.size() - 1;
  const auto S_up = [&](std::size_t i) {
    return -1.0 + 2.0 * mobilised_share(elements, 0.5 * h * static_cast<double>(i));
  };
  const auto S_dn = [&](std::size_t i) {
    return 1.0 - 2.0 * mobilised_share(elements, 0.5 * h * static_cast<double>(last - i));
  };
  return split(nodes.up, nodes.down, S_up, S_dn);
}

}  // namespace

double mobilised_share(std::span<const PlayElement> elements, double u) {
  double share = 0.0;
  for (const PlayElement& e : elements) share += e.weight * std::min(u / e.radius, 1.0);
  return share;
}

PlayLaw identify_loop(const LoopNodes& nodes, std::span<const PlayElement> elements,
                      const Extrapolation& outside) {
  check_nodes(nodes.up.size(), nodes.down.size(), nodes.low, nodes.high);
  check_radii(elements, 0.5 * (nodes.high - nodes.low));
  const ElasticAndFriction parts = split_loop(nodes, elements);
  return make_play_law(make_curve_table(nodes.low, nodes.high, parts.elastic, outside),
                       make_curve_table(nodes.low, nodes.high, parts.friction, constant_outside()), elements);
}

PlayLaw identify_virgin(const VirginNodes& nodes, std::span<const PlayElement> elements, bool mirrored,
                        const Extrapolation& outside) {
  check_nodes(nodes.load.size(), nodes.recovery.size(), 0.0, nodes.high);
  check_radii(elements, nodes.high);
  const std::size_t n = nodes.load.size();
  const double h = nodes.high / static_cast<double>(n - 1);
  const auto S_load = [&](std::size_t i) { return mobilised_share(elements, h * static_cast<double>(i)); };
  // At `high` every element has slipped through (radii <= high), so recovery begins from S = 1.
  const auto S_back = [&](std::size_t i) {
    return 1.0 - 2.0 * mobilised_share(elements, 0.5 * h * static_cast<double>(n - 1 - i));
  };
  ElasticAndFriction parts = split(nodes.load, nodes.recovery, S_load, S_back);
  double low = 0.0;
  if (mirrored) {
    // The mirror image needs F_e(0) = 0: virgin cloth carries nothing.
    std::vector<double> elastic(2 * n - 1), friction(2 * n - 1);
    for (std::size_t i = 0; i < n; ++i) {
      const double value = i == 0 ? 0.0 : parts.elastic[i];
      elastic[n - 1 + i] = value;
      elastic[n - 1 - i] = -value;
      friction[n - 1 + i] = friction[n - 1 - i] = parts.friction[i];
    }
    parts = {std::move(elastic), std::move(friction)};
    low = -nodes.high;
  }
  return make_play_law(make_curve_table(low, nodes.high, parts.elastic, outside),
                       make_curve_table(low, nodes.high, parts.friction, constant_outside()), elements);
}

std::vector<PlayElement> scaled_elements(double largest_radius) {
  std::vector<PlayElement> elements;
  for (double r : {0.05, 0.125, 0.25, 0.5, 1.0}) elements.push_back({r * largest_radius, 0.2});
  return elements;
}

std::vector<PlayElement> smoothest_elements(const LoopNodes& nodes) {
  check_nodes(nodes.up.size(), nodes.down.size(), nodes.low, nodes.high);
  const double half = 0.5 * (nodes.high - nodes.low);
  double best = std::numeric_limits<double>::infinity(), best_radius = half;
  // A hundredth of the half range to all of it, in steps of 10 %: the minimum is flat.
  for (double radius = half; radius > 0.01 * half; radius /= 1.1) {
    const ElasticAndFriction parts = split_loop(nodes, scaled_elements(radius));
    double roughness = 0.0;
    for (std::size_t i = 0; i + 1 < parts.friction.size(); ++i) {
      roughness += std::pow(parts.friction[i + 1] - parts.friction[i], 2);
    }
    if (roughness < best) {
      best = roughness;
      best_radius = radius;
    }
  }
  return scaled_elements(best_radius);
}

}  // namespace fuai
