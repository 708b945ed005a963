// Builds models of cloth pieces: cells, areas, fixed slots; bending and border have their own files.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/cloth_piece.h"

#include <cmath>
#include <limits>
#include <string>

#include "fuai/cloth/cloth_border.h"
#include "fuai/cloth/cut_cells.h"
#include "fuai/cloth/piece_bending.h"
#include "fuai/core/error.h"

namespace fuai {
namespace {

/// A pin further from the nearest slot than this has missed the cloth [spacings]: a diagonal of a cell.
constexpr double kPinReach = 1.5;

std::size_t at(int slot) { return static_cast<std::size_t>(slot); }

void check_numbers(const ClothPieceSpec& spec) {
  if (!(spec.spacing > 0.0) || !std::isfinite(spec.spacing)) {
    throw Error(ErrorKind::kUsage, "the spacing of the yarns must be positive", {"", 0, 0, "spacing"},
                "give metres, for example 0.005");
  }
  if (!(spec.areal_mass >= 0.0) || !std::isfinite(spec.areal_mass)) {
    throw Error(ErrorKind::kUsage, "the mass of a cloth must not be negative", {"", 0, 0, "areal_mass"},
                "give kilograms per square metre, for example 0.15");
  }
  if (!spec.lattice_shift.allFinite()) {
    throw Error(ErrorKind::kUsage, "the shift of the lattice is not finite", {"", 0, 0, "lattice_shift"},
                "give parts of a spacing, 0 to 1");
  }
  for (const Clamp& clamp : spec.clamps) check_region(clamp.region);
}

[[noreturn]] void refuse_coarse(const char* what) {
  throw Error(ErrorKind::kUsage, what, {"", 0, 0, "spacing"},
              "take a smaller spacing: the narrowest part of the piece should span several");
}

/// Size and place of the lattice, such that the outline lies within it.
void place_lattice(const ClothPieceSpec& spec, const Polygon& outline, ClothModel& model) {
  const double inf = std::numeric_limits<double>::infinity();
  Vec2 low(inf, inf), high(-inf, -inf);
  for (const Vec2& p : outline) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  int slots[2];
  for (int axis : {0, 1}) {
    const double shift = spec.lattice_shift[axis] - std::floor(spec.lattice_shift[axis]);
    model.origin[axis] = low[axis] + spec.spacing * (shift > 0.0 ? shift - 1.0 : 0.0);
    const double cells = std::ceil((high[axis] - model.origin[axis]) / spec.spacing - kLatticeSnap);
    if (!(cells < kMostSlotsASide)) {
      throw Error(
          ErrorKind::kUsage,
          "the spacing is so small that a side needs more than " + std::to_string(kMostSlotsASide) + " yarns",
          {"", 0, 0, "spacing"}, "take a larger spacing, or check that outline and spacing are in metres");
    }
    slots[axis] = static_cast<int>(cells) + 1;
  }
  if (slots[0] < 2 || slots[1] < 2) refuse_coarse("the piece is narrower than a spacing");
  model.columns = slots[0];
  model.rows = slots[1];
  model.spacing = spec.spacing;
  model.areal_mass = spec.areal_mass;
}

/// Area and centroid of the cloth that each kept cell carries, lattice coordinates.
struct CellCloth {
  std::vector<double> area;
  std::vector<Vec2> moment;  ///< area times centroid
  void add(int cell, double part, const Vec2& centroid) {
    area[at(cell)] += part;
    moment[at(cell)] += part * centroid;
  }
};

/// What lies in dropped cells goes to the kept cell nearest to its centroid, which for a sliver is the one it
/// shares its longest side with.
CellCloth fill_cells(const Polygon& outline, ClothModel& model) {
  const CutCells cells = make_cut_cells(outline, model.columns, model.rows);
  CellCloth cloth{std::vector<double>(cells.full.size(), 0.0),
                  std::vector<Vec2>(cells.full.size(), Vec2::Zero())};
  for (int cell = 0; cell < model.slot_count(); ++cell) {
    const int column = cell % model.columns, row = cell / model.columns;
    if (cells.full[at(cell)] != 0) cloth.add(cell, 1.0, Vec2(column + 0.5, row + 0.5));
  }
  for (const CutPiece& piece : cells.pieces) {
    const double area = polygon_area(piece.polygon);
    if (area > 0.0) cloth.add(piece.cell, area, polygon_centroid(piece.polygon));
  }
  model.cell_area.assign(cloth.area.size(), 0.0);
  std::vector<std::uint8_t> dropped(cloth.area.size(), 0);
  for (std::size_t i = 0; i < cloth.area.size(); ++i) {
    dropped[i] = cloth.area[i] < kLeastCellShare ? 1 : 0;
    if (dropped[i] != 0) {
      cloth.area[i] = 0.0;
      cloth.moment[i] = Vec2::Zero();
    }
    model.cell_area[i] = cloth.area[i];
  }
  for (const CutPiece& piece : cells.pieces) {
    const double area = polygon_area(piece.polygon);
    if (dropped[at(piece.cell)] == 0 || !(area > 0.0)) continue;
    const int taker = nearest_cell(model, polygon_centroid(piece.polygon));
    if (taker < 0) refuse_coarse("no cell of the lattice has enough of the piece");
    cloth.add(taker, area, polygon_centroid(piece.polygon));
  }
  const double square = model.spacing * model.spacing;
  for (std::size_t i = 0; i < cloth.area.size(); ++i) model.cell_area[i] = cloth.area[i] * square;
  return cloth;
}

/// The centroid of a cell filled to f >= kLeastCellShare lies at least f / 2 from every side. Only cloth of a
/// dropped neighbour can pull it beyond; then the corners far from it keep what makes them move.
double centroid_share(double coordinate) {
  return std::clamp(coordinate, 0.5 * kLeastCellShare, 1.0 - 0.5 * kLeastCellShare);
}

/// Every cell gives its cloth to its corners and sides so that the centre of mass stays where it is: a whole
/// cell a quarter to each corner and half to each pair of sides, a cut one more to those that are nearer.
void share_cells(const CellCloth& cloth, ClothModel& model) {
  const auto count = at(model.slot_count());
  for (auto* area : {&model.node_area, &model.weft_edge_area, &model.warp_edge_area})
    area->assign(count, 0.0);
  model.live.assign(count, 0);
  model.fixed.assign(count, 0);
  const int up = model.columns;
  for (int row = 0; row + 1 < model.rows; ++row) {
    for (int column = 0; column + 1 < model.columns; ++column) {
      const int cell = model.slot(column, row);
      const double area = model.cell_area[at(cell)];
      if (!(area > 0.0)) continue;
      const Vec2 centroid = cloth.moment[at(cell)] / cloth.area[at(cell)] - Vec2(column, row);
      const double right = centroid_share(centroid.x()), top = centroid_share(centroid.y());
      const double across[2] = {1.0 - right, right}, along[2] = {1.0 - top, top};
      for (int j : {0, 1}) {
        for (int i : {0, 1}) {
          const int slot = cell + i + j * up;
          model.live[at(slot)] = 1;
          model.node_area[at(slot)] += across[i] * along[j] * area;
        }
        model.weft_edge_area[at(cell + j * up)] += along[j] * area;
        model.warp_edge_area[at(cell + j)] += across[j] * area;
      }
    }
  }
}

/// The piece hangs together: a walk along yarns with cloth reaches every live slot.
void check_connected(const ClothModel& model) {
  std::vector<std::uint8_t> waiting = model.live;
  std::vector<int> front;
  const auto visit = [&](int slot, double edge_area) {
    if (!(edge_area > 0.0) || waiting[at(slot)] == 0) return;
    waiting[at(slot)] = 0;
    front.push_back(slot);
  };
  for (int slot = 0; front.empty() && slot < model.slot_count(); ++slot) visit(slot, 1.0);
  while (!front.empty()) {
    const int slot = front.back();
    front.pop_back();
    visit(slot + 1 < model.slot_count() ? slot + 1 : slot, model.weft_edge_area[at(slot)]);
    visit(slot + model.columns < model.slot_count() ? slot + model.columns : slot,
          model.warp_edge_area[at(slot)]);
    if (slot >= 1) visit(slot - 1, model.weft_edge_area[at(slot - 1)]);
    if (slot >= model.columns) visit(slot - model.columns, model.warp_edge_area[at(slot - model.columns)]);
  }
  for (std::uint8_t w : waiting) {
    if (w != 0) refuse_coarse("the piece falls apart: a neck of the outline is lost between the yarns");
  }
}

void fix_clamped_slots(const ClothPieceSpec& spec, ClothModel& model) {
  for (const Clamp& clamp : spec.clamps) {
    bool holds = false;
    for (int slot = 0; slot < model.slot_count(); ++slot) {
      if (model.live[at(slot)] == 0 || !clamp_holds(clamp, model, slot)) continue;
      model.fixed[at(slot)] = 1;
      holds = true;
    }
    if (!holds) {
      throw Error(ErrorKind::kUsage, "a clamp holds no cloth", {"", 0, 0, "clamps"},
                  "move it onto the piece; regions are in the coordinates of the outline, in metres");
    }
  }
}

void fix_pinned_slots(const ClothPieceSpec& spec, ClothModel& model) {
  for (const Vec2& pin : spec.pins) {
    int nearest = -1;
    double least = kPinReach * kPinReach * model.spacing * model.spacing;
    for (int slot = 0; slot < model.slot_count(); ++slot) {
      const double distance =
          (model.material(slot % model.columns, slot / model.columns) - pin).squaredNorm();
      if (model.live[at(slot)] == 0 || !(distance < least)) continue;
      least = distance;
      nearest = slot;
    }
    if (nearest < 0) {
      throw Error(ErrorKind::kUsage, "a pin misses the cloth", {"", 0, 0, "pins"},
                  "move it onto the piece; pins are in the coordinates of the outline, in metres");
    }
    model.fixed[at(nearest)] = 1;
  }
}

}  // namespace

ClothModel make_cloth_model(const ClothPieceSpec& spec) {
  check_numbers(spec);
  const Polygon outline = make_outline(spec.outline);
  ClothModel model;
  place_lattice(spec, outline, model);
  const Polygon lattice_outline = to_lattice(outline, model.origin, model.spacing);
  for (const Vec2& p : lattice_outline) model.outline.push_back(model.origin + model.spacing * p);
  share_cells(fill_cells(lattice_outline, model), model);
  check_connected(model);
  if (!fill_bending(lattice_outline, model))
    refuse_coarse("no yarn of the piece is long enough to bend both ways");
  fix_clamped_slots(spec, model);
  fix_pinned_slots(spec, model);
  cut_bending_at_clamps(spec.clamps, model);
  fill_twist(spec.clamps, model);
  model.border = make_border(lattice_outline, model);
  return model;
}

}  // namespace fuai
