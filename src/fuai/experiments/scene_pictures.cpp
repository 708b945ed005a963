// Photographs the scenes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/scene_pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "fuai/cloth/piece_mesh.h"
#include "fuai/fabric/weave.h"

namespace fuai {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

/// Up to this many held nodes are shown as pegs; more are an edge or an area, which a rail or table shows.
constexpr std::size_t kMostPegs = 8;
/// Forces of cloth go from a millinewton to ten newtons: the length of an arrow grows with the logarithm,
/// from nothing at the least force to this part of the scene at the most.
constexpr double kArrowPart = 0.35, kLeastForce = 1e-4, kMostForce = 10.0;  // [-], [N], [N]

std::string force_label(double force) {
  char text[32];
  if (force < 1.0)
    std::snprintf(text, sizeof text, "%.3g mN", 1e3 * force);
  else
    std::snprintf(text, sizeof text, "%.3g N", force);
  return text;
}

double size_of(const EngineScene& scene) { return (scene.view.high - scene.view.low).maxCoeff(); }

/// @param positions of the slots [m]
void add_pegs(const EngineScene& scene, std::span<const Vec3> positions, double size, ClothPicture& picture) {
  std::vector<Vec3> held;
  for (std::size_t slot = 0; slot < positions.size(); ++slot)
    if (scene.model.fixed[slot] != 0) held.push_back(positions[slot]);
  if (held.size() > kMostPegs) return;
  for (const Vec3& x : held) {
    CylinderItem peg;
    peg.radius = 0.01 * size;
    peg.height = 2.5 * peg.radius;
    peg.top = x + 0.5 * peg.height * Vec3::UnitZ();
    peg.colour = {0.35, 0.35, 0.38, 1.0};
    picture.cylinders.push_back(peg);
  }
}

}  // namespace

ClothPicture paper_drape_picture(SurfaceMesh mesh, const std::string& caption, double aspect,
                                 DrapeSupport support) {
  ClothPicture picture;
  Bounds bounds;
  for (const Vec3& p : mesh.positions) bounds.include(p);
  // The block of 5 x 5 fixed particles lies on the table's corner; the top is a cloth's thickness lower.
  BoxItem table;
  table.low = Vec3(-0.03, -0.03, support == DrapeSupport::kTable ? -0.22 : -0.015);
  table.high = Vec3(0.04, 0.04, -0.0015);
  picture.boxes.push_back(table);
  bounds = Bounds();  // the same frame for every fabric: the corner, and cloth up to its own length below
  bounds.include(Vec3(0.02, 0.02, -0.19));
  bounds.include(Vec3(0.10, 0.10, 0.0));
  picture.ground.height = -0.22;
  picture.camera = frame_camera(bounds, 30.0 * kRadPerDegree, 18.0 * kRadPerDegree, aspect);
  picture.caption = caption;
  ClothItem cloth;
  cloth.mesh = std::move(mesh);
  picture.cloths.push_back(std::move(cloth));
  return picture;
}

ClothPicture paper_bending_picture(SurfaceMesh mesh, std::vector<ArrowItem> arrows,
                                   const std::string& caption, double aspect) {
  ClothPicture picture;
  Bounds bounds;
  for (const Vec3& p : mesh.positions) bounds.include(p);
  picture.arrows = std::move(arrows);
  for (const ArrowItem& arrow : picture.arrows) {
    bounds.include(arrow.origin);
    bounds.include(arrow.origin + arrow.vector);
  }
  // What clamps the first two columns.
  BoxItem clamp;
  clamp.low = Vec3(-0.01, -0.01, -0.0165);
  clamp.high = Vec3(0.01, 0.09, -0.0015);
  picture.boxes.push_back(clamp);
  picture.ground.height = std::min(bounds.low.z() - 0.03, clamp.low.z());
  picture.camera = frame_camera(bounds, -60.0 * kRadPerDegree, 20.0 * kRadPerDegree, aspect);
  picture.caption = caption;
  ClothItem cloth;
  cloth.mesh = std::move(mesh);
  picture.cloths.push_back(std::move(cloth));
  return picture;
}

ClothPicture scene_picture(std::string_view scene, SurfaceMesh mesh, const std::string& caption,
                           double aspect) {
  if (scene == "paper_drape") return paper_drape_picture(std::move(mesh), caption, aspect);
  return paper_bending_picture(std::move(mesh), {}, caption, aspect);
}

double force_share(double force) noexcept {
  const double share = std::log(force / kLeastForce) / std::log(kMostForce / kLeastForce);
  return share > 0.0 ? std::min(share, 1.0) : 0.0;
}

void add_pull_arrows(const EngineScene& scene, std::span<const GraspReading> hands, ClothPicture& picture) {
  const double size = size_of(scene);
  for (const GraspReading& hand : hands) {
    const double force = hand.force.norm();
    const double share = force_share(force);
    if (!hand.holds || share == 0.0) continue;
    ArrowItem arrow;
    arrow.origin = hand.centre;
    // The pull of the hand, against what it feels: this way the arrow leaves the cloth and is seen.
    arrow.vector = -hand.force / force * (kArrowPart * size * share);
    arrow.radius = 0.006 * size;
    arrow.label = force_label(force);
    picture.arrows.push_back(arrow);
  }
}

ClothPicture scene_stage_picture(const EngineScene& scene, std::span<const Vec3> positions) {
  ClothPicture picture;
  const double size = size_of(scene);
  double lowest = scene.view.low.z();
  for (const SceneBlock& block : scene.view.blocks) {
    BoxItem box;
    box.low = block.low;
    box.high = block.high;
    picture.boxes.push_back(box);
    lowest = std::min(lowest, block.low.z());
  }
  for (const SceneColumn& column : scene.view.columns) {
    CylinderItem cylinder;
    cylinder.top = column.top;
    cylinder.radius = column.radius;
    cylinder.height = column.height;
    picture.cylinders.push_back(cylinder);
    lowest = std::min(lowest, column.top.z() - column.height);
  }
  for (const Vec3& x : positions) lowest = std::min(lowest, x.z() - 0.02 * size);
  add_pegs(scene, positions, size, picture);
  picture.ground.height = lowest;
  return picture;
}

ClothPicture engine_scene_picture(const EngineScene& scene, const ClothState& state,
                                  std::span<const GraspReading> hands, const std::string& caption,
                                  double aspect) {
  ClothPicture picture = scene_stage_picture(scene, state.positions);
  Bounds bounds;
  bounds.include(scene.view.low);
  bounds.include(scene.view.high);
  const double size = size_of(scene);
  add_pull_arrows(scene, hands, picture);
  for (const ArrowItem& arrow : picture.arrows) {
    const Vec3 tip = arrow.origin + arrow.vector;
    bounds.include(tip);
    picture.ground.height = std::min(picture.ground.height, tip.z() - 0.03 * size);
  }
  picture.camera = frame_camera(bounds, scene.view.azimuth, scene.view.elevation, aspect);
  picture.caption = caption;
  ClothItem cloth;
  cloth.mesh = make_piece_mesh(scene.model, state.positions).mesh;
  cloth.thread_spacing = scene.model.spacing;
  picture.cloths.push_back(std::move(cloth));
  return picture;
}

YarnItem yarns_of(const Fabric& fabric) {
  const Weave weave = weave_of(fabric);
  return {weave.structure, weave.warp_pitch, weave.weft_pitch};
}

}  // namespace fuai
