// Photographs the scenes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/scene_pictures.h"

#include <numbers>
#include <utility>

namespace fuai {
namespace {

constexpr double kRadPerDegree = std::numbers::pi / 180.0;

}  // namespace

ClothPicture paper_drape_picture(SurfaceMesh mesh, const std::string& caption, double aspect) {
  ClothPicture picture;
  Bounds bounds;
  for (const Vec3& p : mesh.positions) bounds.include(p);
  // The block of 5 x 5 fixed particles lies on the table's corner; the top is a cloth's thickness lower.
  BoxItem table;
  table.low = Vec3(-0.03, -0.03, -0.22);
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
  picture.ground.height = bounds.low.z() - 0.03;
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

}  // namespace fuai
