// Gives triples their cloth and cuts them at clamp edges.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/piece_bending.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/cloth/cut_cells.h"
#include "fuai/cloth/piece_yarns.h"

namespace fuai {
namespace {

std::size_t at(int slot) { return static_cast<std::size_t>(slot); }

/// A straight piece of the outline along a lattice line.
struct LineEdge {
  int axis;          ///< of the yarns that end on it: 0 when it runs along y
  double line;       ///< its coordinate along those yarns
  double low, high;  ///< its extent across them
};

std::vector<LineEdge> edges_on_lattice_lines(const Polygon& outline) {
  std::vector<LineEdge> edges;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    for (int axis : {0, 1}) {
      if (a[axis] != b[axis] || a[axis] != std::round(a[axis])) continue;
      edges.push_back(
          {axis, a[axis], std::min(a[1 - axis], b[1 - axis]), std::max(a[1 - axis], b[1 - axis])});
    }
  }
  return edges;
}

/// Whether a yarn ends in this slot squarely on the outline. Then the last half spacing of cloth is a free
/// end without moment and nobody needs to bend it; elsewhere the last slot lies beyond the outline or the
/// outline runs aslant, and the cloth about it bends with the yarn inside. The rule for the end of a yarn is
/// here and only here.
bool end_needs_no_bending(const std::vector<LineEdge>& edges, const YarnArrays& yarns, const Vec2& slot) {
  return std::any_of(edges.begin(), edges.end(), [&](const LineEdge& edge) {
    const double across = slot[1 - yarns.axis];
    return edge.axis == yarns.axis && edge.line == slot[yarns.axis] && edge.low < across + 1.0 &&
           edge.high > across - 1.0;
  });
}

/// Both edges of the triple carry cloth (then all three slots are live).
bool has_triple(const YarnArrays& yarns, int slot) {
  return slot >= yarns.stride && yarns.edge_area[at(slot)] > 0.0 &&
         yarns.edge_area[at(slot - yarns.stride)] > 0.0;
}

void fill_direction(const std::vector<LineEdge>& edges, ClothModel& model, const YarnArrays& yarns) {
  yarns.bend_area.assign(model.node_area.size(), 0.0);
  yarns.bend_length.assign(model.node_area.size(), model.spacing);
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    if (model.live[at(slot)] == 0) continue;
    if (has_triple(yarns, slot)) {
      yarns.bend_area[at(slot)] += model.node_area[at(slot)];
      continue;
    }
    // The end of a yarn: one of its edges leads inward.
    const bool forward = yarns.edge_area[at(slot)] > 0.0;
    const int inward = slot + (forward ? yarns.stride : -yarns.stride);
    const Vec2 place(slot % model.columns, slot / model.columns);
    if (has_triple(yarns, inward) && !end_needs_no_bending(edges, yarns, place)) {
      yarns.bend_area[at(inward)] += model.node_area[at(slot)];
    }
  }
}

/// Share of a cell outside all sub-cell clamps, by 16 x 16 samples. @param low corner of the cell [m]
double free_part(std::span<const Clamp> clamps, const ClothModel& model, const Vec2& low) {
  constexpr int kSamples = 16;
  int free = 0;
  for (int j = 0; j < kSamples; ++j) {
    for (int i = 0; i < kSamples; ++i) {
      const Vec2 sample = low + model.spacing / kSamples * Vec2(i + 0.5, j + 0.5);
      const bool held = std::any_of(clamps.begin(), clamps.end(), [&](const Clamp& clamp) {
        return clamp.sub_cell && region_signed_distance(clamp.region, sample) < 0.0;
      });
      free += held ? 0 : 1;
    }
  }
  return static_cast<double>(free) / (kSamples * kSamples);
}

/// Lengths that a clamp's edge adds to the triples in the last fixed slot and the next two, so that what they
/// sum is an integral to third order; shares of the spacing. g and k: docs/theory/cloth-pieces.md, "Clamps".
/// @param s edge beyond the fixed slot, share of the spacing  @param next triples after the one in that slot
std::array<double, 3> end_shares(double s, int next) {
  const double held = std::clamp(s, -0.5, 0.5);  // beyond it the yarn grazes the clamp
  const double g = 1.0 / 12.0 - 0.5 * held * held, k = held * held * held / 6.0;
  if (next == 0) return {-0.5 - s, 0.0, 0.0};
  if (next == 1) return {-0.5 - s - g, g, 0.0};
  return {-0.5 - s - 1.5 * g - k, 2.0 * g + 2.0 * k, -0.5 * g - k};
}

/// Makes the triple in slot `i` longer [m]; its width stays.
void add_bend_length(const YarnArrays& yarns, std::size_t i, double length) {
  yarns.bend_area[i] *= 1.0 + length / yarns.bend_length[i];
  yarns.bend_length[i] += length;
}

void cut_direction(std::span<const Clamp> clamps, ClothModel& model, const YarnArrays& yarns) {
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    if (model.fixed[at(slot)] == 0 || !(yarns.bend_area[at(slot)] > 0.0)) continue;
    const bool low_free = model.fixed[at(slot - yarns.stride)] == 0;
    const bool high_free = model.fixed[at(slot + yarns.stride)] == 0;
    if (low_free == high_free) continue;  // wholly held, or a clamp so narrow that it cuts both sides
    Vec2 outward = Vec2::Zero();
    outward[yarns.axis] = high_free ? 1.0 : -1.0;
    // Of several clamps the one that reaches furthest counts.
    double exit = -std::numeric_limits<double>::infinity();
    bool sub_cell = false;
    for (const Clamp& clamp : clamps) {
      if (!clamp.sub_cell || !clamp_holds(clamp, model, slot)) continue;
      const Vec2 place = model.material(slot % model.columns, slot / model.columns);
      exit = std::max(exit, region_exit_distance(clamp.region, place, outward));
      sub_cell = true;
    }
    if (!sub_cell) continue;
    const int outward_step = high_free ? yarns.stride : -yarns.stride;
    const auto bends = [&](int i) { return yarns.bend_area[at(i)] > 0.0; };
    int next = 0;
    while (next < 2 && bends(slot + (next + 1) * outward_step)) ++next;
    std::array<double, 3> shares = end_shares(exit / model.spacing, next);
    shares[0] = std::clamp(1.0 + shares[0], 1.0 / kMostClampFactor, 1.0 / kLeastClampFactor) - 1.0;
    for (int i = 0; i <= next; ++i)
      add_bend_length(yarns, at(slot + i * outward_step),
                      shares[static_cast<std::size_t>(i)] * model.spacing);
  }
}

}  // namespace

bool fill_bending(const Polygon& outline, ClothModel& model) {
  const std::vector<LineEdge> edges = edges_on_lattice_lines(outline);
  fill_direction(edges, model, weft_arrays(model));
  fill_direction(edges, model, warp_arrays(model));
  for (std::size_t i = 0; i < model.node_area.size(); ++i) {
    if (model.weft_bend_area[i] > 0.0 && model.warp_bend_area[i] > 0.0) return true;
  }
  return false;
}

bool clamp_holds(const Clamp& clamp, const ClothModel& model, int slot) {
  const Vec2 place = model.material(slot % model.columns, slot / model.columns);
  const double distance = region_signed_distance(clamp.region, place);
  // Snapped, so that a slot half a spacing outside is free and one on the edge is held, whatever the
  // rounding.
  return clamp.sub_cell ? distance < (0.5 - kLatticeSnap) * model.spacing
                        : distance < kLatticeSnap * model.spacing;
}

void cut_bending_at_clamps(std::span<const Clamp> clamps, ClothModel& model) {
  cut_direction(clamps, model, weft_arrays(model));
  cut_direction(clamps, model, warp_arrays(model));
}

void fill_twist(std::span<const Clamp> clamps, ClothModel& model) {
  model.twist_area = model.cell_area;
  const int up = model.columns;
  for (int cell = 0; cell < model.slot_count(); ++cell) {
    if (!(model.cell_area[at(cell)] > 0.0)) continue;
    int held = 0;
    for (int slot : {cell, cell + 1, cell + up, cell + up + 1}) held += model.fixed[at(slot)];
    if (held == 0 || held == 4) continue;
    const double free = free_part(clamps, model, model.material(cell % up, cell / up));
    model.twist_area[at(cell)] /= std::max(free, 1.0 / kMostClampFactor);
  }
}

}  // namespace fuai
