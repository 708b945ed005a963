// Hangs a strip of cloth and reads its bending length.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/cantilever.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

#include "fuai/cloth/cloth_piece.h"
#include "fuai/cloth/material_point.h"
#include "fuai/core/error.h"
#include "fuai/experiments/elastica.h"
#include "fuai/solver/cloth_material.h"
#include "fuai/solver/cylinder_equilibrium.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// Spacings of cloth inside the clamp: two slots hold the tangent of each yarn (see Clamp).
constexpr double kHeldSpacings = 2.0;

std::string millimetres(double length) {
  std::string text = std::to_string(length / unit::kMillimetre);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text + " mm";
}

void check_positive(double value, const char* name) {
  if (!(value > 0.0) || !std::isfinite(value)) {
    throw Error(ErrorKind::kUsage, std::string("the ") + name + " of a strip must be more than 0", {},
                "give a length such as 10cm");
  }
}

/// Checks everything and returns the spacing. @throws Error (kUsage)
double checked_spacing(const CantileverOptions& o) {
  if (o.direction == Direction::kBias) {
    throw Error(ErrorKind::kUsage, "a strip on the bias is not simulated", {},
                "take the warp or the weft direction");
  }
  check_positive(o.length, "length");
  check_positive(o.width, "width");
  if (o.spacing != 0.0) check_positive(o.spacing, "spacing");
  const double h = o.spacing != 0.0 ? o.spacing : std::min(o.length / kCantileverSegments, 0.5 * o.width);
  const double segments = o.length / h, rounding = 1e-9;
  if (segments < kLeastCantileverSegments - rounding) {
    throw Error(ErrorKind::kUsage,
                "a strip of " + millimetres(o.length) + " is shorter than four spacings of " + millimetres(h),
                {}, "take a longer strip or a smaller spacing");
  }
  if (segments > kMostCantileverSegments + rounding) {
    throw Error(
        ErrorKind::kUsage,
        "a strip of " + millimetres(o.length) + " is longer than a thousand spacings of " + millimetres(h),
        {}, "take a shorter strip or a larger spacing");
  }
  if (o.width < (2.0 - rounding) * h) {
    throw Error(
        ErrorKind::kUsage,
        "a strip of " + millimetres(o.width) + " width is narrower than two spacings of " + millimetres(h),
        {}, "take a wider strip or a smaller spacing");
  }
  return h;
}

/// A point of the strip by its place along and across it, material coordinates.
Vec2 strip_point(Direction direction, double along, double across) {
  return direction == Direction::kWeft ? Vec2(along, across) : Vec2(across, along);
}

ClothModel make_strip(const FabricLaws& laws, const CantileverOptions& o, double spacing) {
  const double held = kHeldSpacings * spacing;
  ClothPieceSpec spec;
  for (const auto& [along, across] :
       {std::pair{-held, 0.0}, {o.length, 0.0}, {o.length, o.width}, {-held, o.width}})
    spec.outline.push_back(strip_point(o.direction, along, across));
  spec.spacing = spacing;
  spec.areal_mass = laws.areal_mass;
  spec.clamps.push_back({HalfPlaneRegion{strip_point(o.direction, 1.0, 0.0), 0.0}, true});
  return make_cloth_model(spec);
}

PlayLaw elastic_part(const PlayLaw& law) {
  const CurveTable& elastic = law.elastic();
  if (elastic.node_count() == 0) return law;
  const std::array<double, 2> none{0.0, 0.0};
  return make_play_law(elastic, make_curve_table(elastic.low(), elastic.high(), none, constant_outside()),
                       law.elements());
}

/// Where the tip is against the clamp, in the plane of bending: along the strip and up.
void read_shape(const CantileverOptions& o, CantileverResult& result) {
  const ClothModel& model = result.model;
  const auto at = [&](double along) {
    const MaterialPoint point = make_material_point(model, strip_point(o.direction, along, 0.5 * o.width));
    const Vec3 x = material_position(point, result.state.positions);
    return o.direction == Direction::kWeft ? Vec2(x.x(), x.z()) : Vec2(x.y(), x.z());
  };
  const Vec2 tip = at(o.length), last = tip - at(o.length - result.spacing);
  result.reach = tip.x();
  result.droop = -tip.y();
  result.tip_angle = std::atan2(-last.y(), last.x());
  result.chord_angle = std::atan2(result.droop, result.reach);
}

void evaluate(double weight_per_area, double length, CantileverResult& result) {
  result.bending_length = result.bending_length_peirce = std::numeric_limits<double>::quiet_NaN();
  result.bending_rigidity = result.bending_length;
  // Level or rising by its own curl, or so limp that it hangs straight down: no elastica.
  static const double most = heavy_elastica(kMostElasticaLoad).chord_angle;
  if (!(result.chord_angle > 0.0 && result.chord_angle < most)) return;
  result.bending_length = length / std::cbrt(heavy_elastica_load(result.chord_angle));
  result.bending_length_peirce = length / std::cbrt(peirce_load(result.chord_angle));
  result.bending_rigidity = weight_per_area * std::pow(result.bending_length, 3);
}

}  // namespace

FabricLaws without_friction(const FabricLaws& laws) {
  FabricLaws elastic = laws;
  for (PlayLaw& law : elastic.bending) law = elastic_part(law);
  for (PlayLaw& law : elastic.tensile) law = elastic_part(law);
  elastic.shear = elastic_part(elastic.shear);
  return elastic;
}

CantileverResult run_cantilever(const FabricLaws& laws, const CantileverOptions& options,
                                const Progress& progress) {
  CantileverResult result;
  result.spacing = checked_spacing(options);
  const ClothMaterial material = make_cloth_material(options.elastic ? without_friction(laws) : laws);
  result.model = make_strip(laws, options, result.spacing);
  result.state = make_cloth_state(result.model);
  EquilibriumOptions solve;
  solve.load_steps = options.load_steps;
  solve.tolerance = options.tolerance;
  result.equilibrium =
      find_cylinder_equilibrium(result.model, material, options.direction, result.state, solve, progress);
  read_shape(options, result);
  evaluate(laws.areal_mass * kStandardGravity, options.length, result);
  result.assumptions = material.notes;
  result.assumptions.emplace_back("the strip hangs face up, from flat and without a past");
  if (options.elastic) result.assumptions.emplace_back("friction was left out");
  std::ranges::move(assumptions_of(laws), std::back_inserter(result.assumptions));
  return result;
}

}  // namespace fuai
