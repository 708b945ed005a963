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
  bool high = false;
  Vec2 crossing = Vec2::Zero();
  Polygon corners;
  std::size_t partner = 0;  ///< the chain whose crossing is the other end of the cut
};

/// Which side each corner belongs to. Corners on the line go where the cut leaves simple polygons on both
/// sides: those of an edge along the line to the side on which the cloth lies (left of the edge), one that
/// only touches the line to the other side than its neighbours.
/// @param first a corner that is not on the line
std::vector<bool> sides_of_corners(const Polygon& polygon, int axis, double at, std::size_t first) {
  const std::size_t n = polygon.size();
  std::vector<bool> high(n);
  for (std::size_t k = 0; k < n;) {
    const std::size_t begin = (first + k) % n;
    if (polygon[begin][axis] != at) {
      high[begin] = polygon[begin][axis] > at;
      ++k;
      continue;
    }
    std::size_t count = 1;
    while (polygon[(begin + count) % n][axis] == at) ++count;
    const Vec2 way = polygon[(begin + count - 1) % n] - polygon[begin];
    bool side = !high[(begin + n - 1) % n] && !(polygon[(begin + 1) % n][axis] > at);
    if (count > 1) side = axis == 1 ? way.x() > 0.0 : way.y() < 0.0;
    for (std::size_t i = 0; i < count; ++i) high[(begin + i) % n] = side;
    k += count;
  }
  return high;
}

/// Where an edge from its low to its high end meets the line x = at (axis 0) or y = at (axis 1): exactly in
/// an end that lies on the line.
Vec2 crossing_of(const Vec2& low, const Vec2& high, int axis, double at) {
  if (high[axis] == at) return high;
  const int along = 1 - axis;
  const double share = (at - low[axis]) / (high[axis] - low[axis]);
  Vec2 crossing;
  crossing[axis] = at;
  crossing[along] = low[along] + share * (high[along] - low[along]);
  return crossing;
}

/// The polygon, which has corners on both sides, as chains in its order.
std::vector<Chain> make_chains(const Polygon& polygon, int axis, double at) {
  const std::size_t n = polygon.size();
  std::size_t first = 0;
  while (polygon[first][axis] == at) ++first;
  const std::vector<bool> high = sides_of_corners(polygon, axis, at, first);
  first = 0;  // a corner that begins a chain
  while (high[first] == high[(first + n - 1) % n]) ++first;
  std::vector<Chain> chains;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t here = (first + k) % n, before = (here + n - 1) % n;
    if (high[here] != high[before]) {
      const Vec2 &low_end = polygon[high[here] ? before : here],
                 &high_end = polygon[high[here] ? here : before];
      chains.push_back({high[here], crossing_of(low_end, high_end, axis, at), {}, 0});
    }
    chains.back().corners.push_back(polygon[here]);
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
  const auto is_low = [&](const Vec2& p) { return p[axis] < at; };
  const auto is_high = [&](const Vec2& p) { return p[axis] > at; };
  const bool any_high = std::any_of(polygon.begin(), polygon.end(), is_high);
  if (!any_high || std::none_of(polygon.begin(), polygon.end(), is_low)) {
    (any_high ? split.high : split.low).push_back(polygon);
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
