// Cuts the specimen and clamps it.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/specimen.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/error.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {
namespace {

/// Spacings of cloth inside each clamp: two slots hold the tangent of a yarn (see Clamp).
constexpr double kHeldSpacings = 2.0;

SpecimenSpec checked(const SpecimenSpec& spec) {
  if (spec.along == Direction::kBias)
    throw Error(ErrorKind::kUsage, "a specimen lies along the warp or the weft", {},
                "take the warp or the weft direction");
  const double parts = spec.length / spec.spacing;
  if (!(spec.length > 0.0) || !(spec.spacing > 0.0) || !(spec.width >= 2.0 * spec.spacing) ||
      !(std::abs(parts - std::round(parts)) < 1e-6) || parts < 2.0 - 1e-6) {
    throw Error(
        ErrorKind::kUsage,
        "the spacing must divide the length of a specimen into at least two parts, and its width must "
        "be two spacings or more",
        {}, "take a spacing such as a tenth of the length");
  }
  return spec;
}

/// A point by its place along and across, material coordinates.
Vec2 point(Direction direction, double along, double across) {
  return direction == Direction::kWeft ? Vec2(along, across) : Vec2(across, along);
}

ClothModel make_model(const FabricLaws& laws, const SpecimenSpec& spec) {
  const double held = kHeldSpacings * spec.spacing, L = spec.length, W = spec.width;
  ClothPieceSpec piece;
  for (const auto& [along, across] : {std::pair{-held, 0.0}, {L + held, 0.0}, {L + held, W}, {-held, W}})
    piece.outline.push_back(point(spec.along, along, across));
  piece.spacing = spec.spacing;
  piece.areal_mass = laws.areal_mass;
  const Vec2 outward = point(spec.along, 1.0, 0.0);
  piece.clamps = {{HalfPlaneRegion{outward, 0.0}, true}, {HalfPlaneRegion{-outward, -L}, true}};
  return make_cloth_model(piece);
}

SolverStatic make_solver(const FabricLaws& laws, const SpecimenSpec& spec) {
  const ClothModel model = make_model(laws, spec);
  StaticOptions options;
  options.gravity = spec.gravity;
  const bool weft = spec.along == Direction::kWeft;
  options.axes = spec.bends ? std::array<bool, 3>{weft, !weft, true} : std::array<bool, 3>{true, true, false};
  return SolverStatic(model, make_cloth_material(laws), make_cloth_state(model), options);
}

double place_along(const SpecimenSpec& spec, const ClothModel& model, int slot) {
  return model.material(slot % model.columns, slot / model.columns)[spec.along == Direction::kWeft ? 0 : 1];
}

}  // namespace

Specimen::Specimen(const FabricLaws& laws, const SpecimenSpec& spec)
    : spec_(checked(spec)),
      along_(spec.along == Direction::kWeft ? Vec3::UnitX() : Vec3::UnitY()),
      across_(spec.along == Direction::kWeft ? Vec3::UnitY() : Vec3::UnitX()),
      solver_(make_solver(laws, spec_)) {
  const ClothModel& m = solver_.model();
  std::vector<int> low, high;
  for (int slot = 0; slot < m.slot_count(); ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    if (m.live[i] == 0 || m.fixed[i] == 0) continue;
    (place_along(spec_, m, slot) < 0.5 * spec_.length ? low : high).push_back(slot);
  }
  const Vec3 middle = 0.5 * spec_.width * across_;
  fixed_ = solver_.add_clamp(low, middle);
  moving_ = solver_.add_clamp(high, middle + spec_.length * along_);
}

StaticReport Specimen::settle_turned(const Mat3& rotation, double change) {
  const ClothModel& m = solver_.model();
  const bool weft = spec_.along == Direction::kWeft;
  const int lines = weft ? m.rows : m.columns, stations = weft ? m.columns : m.rows;
  const std::vector<Vec3>& now = solver_.state().positions;
  std::vector<Vec3> next = now;
  for (int line = 0; line < lines; ++line) {
    std::size_t before = 0;
    for (int station = 0; station < stations; ++station) {
      const int slot = weft ? m.slot(station, line) : m.slot(line, station);
      const auto i = static_cast<std::size_t>(slot);
      const double place = place_along(spec_, m, slot) - 0.5 * spec_.spacing;  // middle of the segment
      const double share = std::clamp(place / spec_.length, 0.0, 1.0);
      if (station > 0)
        next[i] = next[before] + Eigen::AngleAxisd(share * change, bend_axis()) * (now[i] - now[before]);
      // All lines are alike: the first one says where the clamp goes.
      if (line == 0 && std::abs(place + 0.5 * spec_.spacing - spec_.length) < 1e-6 * spec_.spacing)
        solver_.suggest_shift(moving_, next[i] - now[i]);
      before = i;
    }
  }
  solver_.suggest(next);
  return settle(rotation, Vec3::Zero());
}

void Specimen::raise(const std::function<double(double)>& height) {
  const ClothModel& m = solver_.model();
  std::vector<Vec3> raised = solver_.state().positions;
  for (int slot = 0; slot < m.slot_count(); ++slot)
    raised[static_cast<std::size_t>(slot)].z() = height(place_along(spec_, m, slot) / spec_.length);
  solver_.suggest(raised);
}

StaticReport Specimen::settle(const Mat3& rotation, const Vec3& shift) {
  solver_.place(moving_, rotation, shift);
  return solver_.settle();
}

}  // namespace fuai
