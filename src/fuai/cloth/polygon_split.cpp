// Cuts a simple polygon by an axis-parallel line into simple polygons.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/cloth-pieces.md, "Cells".
#include <algorithm>
#include <utility>

#include "fuai/cloth/outline.h"

namespace fuai {
namespace {

/// A run of corners on one side of the line, with the crossing that leads into it.
struct Chain {
  bool high = false;  ///< side of the line; a corner on the line counts as low
  Vec2 crossing = Vec2::Zero();
  Polygon corners;
  std::size_t partner = 0;  ///< the chain whose crossing is the other end of the cut
};

/// Where an edge from its low to its high end meets the line x = at (axis 0) or y = at (axis 1): exactly in
/// the low end when that lies on the line.
Vec2 crossing_of(const Vec2& low, const Vec2& high, int axis, double at) {
  const int along = 1 - axis;
  const double share = (at - low[axis]) / (high[axis] - low[axis]);
  Vec2 crossing;
  crossing[axis] = at;
  crossing[along] = low[along] + share * (high[along] - low[along]);
  return crossing;
}

/// The polygon as chains in its order; at least two.
std::vector<Chain> make_chains(const Polygon& polygon, int axis, double at) {
  const auto is_high = [&](const Vec2& p) { return p[axis] > at; };
  const std::size_t n = polygon.size();
  std::size_t first = 0;  // a corner that begins a chain
  while (is_high(polygon[first]) == is_high(polygon[(first + n - 1) % n])) ++first;
  std::vector<Chain> chains;
  for (std::size_t k = 0; k < n; ++k) {
    const Vec2 &before = polygon[(first + k + n - 1) % n], &here = polygon[(first + k) % n];
    if (is_high(here) != is_high(before)) {
      chains.emplace_back().high = is_high(here);
      chains.back().crossing =
          is_high(here) ? crossing_of(before, here, axis, at) : crossing_of(here, before, axis, at);
    }
    chains.back().corners.push_back(here);
  }
  return chains;
}

/// Pairs the crossings. A simple polygon crosses a line alternately upward and downward, so the k-th of one
/// kind belongs to the k-th of the other; an upward and a downward one in the same place (a corner on the
/// line) or in the wrong order by rounding do no harm.
void pair_crossings(std::vector<Chain>& chains, int axis) {
  const int along = 1 - axis;
  std::vector<std::size_t> of_kind[2];
  for (std::size_t i = 0; i < chains.size(); ++i) of_kind[chains[i].high ? 1 : 0].push_back(i);
  for (auto& list : of_kind) {
    std::sort(list.begin(), list.end(), [&](std::size_t a, std::size_t b) {
      return chains[a].crossing[along] < chains[b].crossing[along];
    });
  }
  for (std::size_t k = 0; k < of_kind[0].size(); ++k) {
    chains[of_kind[0][k]].partner = of_kind[1][k];
    chains[of_kind[1][k]].partner = of_kind[0][k];
  }
}

void append(Polygon& polygon, const Vec2& corner) {
  if (polygon.empty() || polygon.back() != corner) polygon.push_back(corner);
}

/// A loop is kept when it has at least three corners that are not all on the line.
void keep_loop(std::vector<Polygon>& loops, Polygon loop, int axis, double at) {
  while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
  const bool flat = std::all_of(loop.begin(), loop.end(), [&](const Vec2& p) { return p[axis] == at; });
  if (loop.size() >= 3 && !flat) loops.push_back(std::move(loop));
}

}  // namespace

SplitPolygon split_polygon(const Polygon& polygon, int axis, double at) {
  SplitPolygon split;
  const auto high =
      std::count_if(polygon.begin(), polygon.end(), [&](const Vec2& p) { return p[axis] > at; });
  if (high == 0 || high == static_cast<std::ptrdiff_t>(polygon.size())) {
    (high == 0 ? split.low : split.high).push_back(polygon);
    return split;
  }
  std::vector<Chain> chains = make_chains(polygon, axis, at);
  pair_crossings(chains, axis);
  // Follow a chain to its last crossing, go along the line to the partner, and so on until the loop closes.
  std::vector<bool> done(chains.size(), false);
  for (std::size_t start = 0; start < chains.size(); ++start) {
    Polygon loop;
    for (std::size_t i = start; !done[i];) {
      done[i] = true;
      append(loop, chains[i].crossing);
      for (const Vec2& corner : chains[i].corners) append(loop, corner);
      const Chain& next = chains[(i + 1) % chains.size()];
      append(loop, next.crossing);
      i = next.partner;
    }
    keep_loop(chains[start].high ? split.high : split.low, std::move(loop), axis, at);
  }
  return split;
}

}  // namespace fuai
