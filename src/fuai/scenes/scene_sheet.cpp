// Builds the sheets.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/scene_sheet.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "fuai/cloth/material_point.h"
#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Slack of the clamped sheet, and the length of its waves [m]: folds of a hand's breadth.
constexpr double kSlack = 0.05, kWaveLength = 0.1;
/// A wave needs this many columns to be one.
constexpr double kColumnsPerWave = 8.0;
constexpr int kClampedSheetSize = 32;

Vec3 upright(const ClothModel& model, int column, int row) {
  const Vec2 m = model.material(column, row);
  return {m.x(), 0.0, m.y() - model.material(0, model.rows - 1).y()};
}

/// The angle a for which the mean of cos(a cos t) is 1 - slack, that is J0(a), by Newton's method.
double wave_angle(double slack) {
  double angle = 2.0 * std::sqrt(slack);
  for (int i = 0; i < 20; ++i)
    angle += (std::cyl_bessel_j(0.0, angle) - (1.0 - slack)) / std::cyl_bessel_j(1.0, angle);
  return angle;
}

}  // namespace

SceneOptions fill_scene_options(const SceneOptions& options, int own_size, double own_spacing) {
  SceneOptions filled = options;
  if (options.size == 0) filled.size = own_size;
  if (options.spacing == 0.0) filled.spacing = own_spacing;
  if (filled.size < kLeastSceneSize || filled.size > kMostSceneSize) {
    throw Error(ErrorKind::kUsage,
                "a scene cannot be made of " + std::to_string(filled.size) + " nodes a side",
                {"", 0, 0, "size"},
                "take " + std::to_string(kLeastSceneSize) + " to " + std::to_string(kMostSceneSize));
  }
  if (!(filled.spacing >= kLeastSceneSpacing && filled.spacing <= kMostSceneSpacing)) {
    throw Error(ErrorKind::kUsage, "the spacing of a scene's yarns is out of range", {"", 0, 0, "spacing"},
                "take 0.1mm to 10cm");
  }
  return filled;
}

ClothPieceSpec make_sheet_spec(const FabricLaws& laws, int columns, int rows, double spacing) {
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline((columns - 1) * spacing, (rows - 1) * spacing);
  spec.spacing = spacing;
  spec.areal_mass = laws.areal_mass;
  return spec;
}

EngineScene make_sheet_scene(const char* name, const FabricLaws& laws, const ClothPieceSpec& spec) {
  EngineScene scene;
  scene.name = name;
  scene.model = make_cloth_model(spec);
  scene.material = make_cloth_material(laws);
  scene.start = make_cloth_state(scene.model);
  return scene;
}

Clamp make_top_edge_clamp(double height, double spacing) {
  // Half a spacing deep and not sub-cell: the yarns turn freely in the last row, and the depth decides
  // nothing.
  return {HalfPlaneRegion{-Vec2::UnitY(), -(height - 0.5 * spacing)}, false};
}

void hang_upright(EngineScene& scene) {
  const ClothModel& model = scene.model;
  for (int row = 0; row < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column) {
      scene.start.positions[static_cast<std::size_t>(model.slot(column, row))] = upright(model, column, row);
    }
  }
}

void hang_in_waves(EngineScene& scene, double slack) {
  const ClothModel& model = scene.model;
  const double h = model.spacing, width = (model.columns - 1) * h;
  const double waves = std::max(1.0, std::round(width / std::max(kWaveLength, kColumnsPerWave * h)));
  const double angle = wave_angle(slack);
  // Chord after chord of rest length, so that no yarn is stretched.
  Vec3 at(0.5 * slack * width, 0.0, 0.0);
  for (int column = 0; column < model.columns; ++column) {
    for (int row = 0; row < model.rows; ++row) {
      const Vec3 height(0.0, 0.0, upright(model, column, row).z());
      scene.start.positions[static_cast<std::size_t>(model.slot(column, row))] = at + height;
    }
    const double phase = 2.0 * std::numbers::pi * waves * (column + 0.5) / (model.columns - 1);
    const double slope = angle * std::cos(phase);
    at += h * Vec3(std::cos(slope), std::sin(slope), 0.0);
  }
}

EngineScene make_clamped_sheet(const char* name, const FabricLaws& laws, const SceneOptions& options) {
  const SceneOptions o = fill_scene_options(options, kClampedSheetSize);
  const double side = (o.size - 1) * o.spacing;
  ClothPieceSpec spec = make_sheet_spec(laws, o.size, o.size, o.spacing);
  spec.clamps.push_back(make_top_edge_clamp(side, o.spacing));
  EngineScene scene = make_sheet_scene(name, laws, spec);
  hang_in_waves(scene, kSlack);
  GraspSpec finger;
  finger.centre = Vec2(0.5 * side, std::min(finger.radius, 0.25 * side));  // all of the patch on the cloth
  scene.hands.push_back(finger);
  scene.view.azimuth = -65.0 * std::numbers::pi / 180.0;
  scene.view.elevation = 12.0 * std::numbers::pi / 180.0;
  scene.view.low = Vec3(0.0, -0.35 * side, -1.1 * side);
  scene.view.high = Vec3(side, 0.1 * side, 0.02);
  scene.view.blocks.push_back({Vec3(-0.02, -0.012, 0.0), Vec3(side + 0.02, 0.024, 0.015)});
  return scene;
}

Vec3 start_position(const EngineScene& scene, const Vec2& material) {
  return material_position(make_material_point(scene.model, material), scene.start.positions);
}

}  // namespace fuai
