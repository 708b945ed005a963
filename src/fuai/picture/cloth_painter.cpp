// The three phases of drawing cloth.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/cloth_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "fuai/picture/draw_mesh.h"
#include "fuai/picture/shaders.h"

namespace fuai {
namespace {

constexpr int kAmbientSize = 128;  // side of one depth picture of the soft light [texel]
constexpr int kKeySize = 2048;     // side of the depth picture of the key light [texel]
constexpr int kColourMapSize = 256;
enum Kind { kCloth = 0, kObstacle = 1, kArrow = 2, kGround = 3 };
enum Unit { kAmbientUnit = 0, kKeyUnit = 1, kColourMapUnit = 2, kTextureUnit = 3 };

/// Vertices and triangles on the card.
class GpuMesh {
 public:
  explicit GpuMesh(const DrawMesh& mesh) : count_(static_cast<GLsizei>(mesh.indices.size())) {
    glBindVertexArray(array_.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertices_.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(DrawVertex)),
                 mesh.vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                 static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)), mesh.indices.data(),
                 GL_STATIC_DRAW);
    const auto attribute = [](GLuint index, GLint size, std::size_t offset) {
      glEnableVertexAttribArray(index);
      // OpenGL takes the offset in a buffer as a pointer. NOLINTNEXTLINE(performance-no-int-to-ptr)
      const void* in_buffer = reinterpret_cast<const void*>(offset);
      glVertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(DrawVertex), in_buffer);
    };
    attribute(0, 3, offsetof(DrawVertex, position));
    attribute(1, 3, offsetof(DrawVertex, normal));
    attribute(2, 2, offsetof(DrawVertex, material));
    attribute(3, 2, offsetof(DrawVertex, value));
  }
  void draw() const {
    glBindVertexArray(array_.name());
    glDrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
  }

 private:
  GlVertexArray array_;
  GlBuffer vertices_, indices_;
  GLsizei count_;
};

/// Directions spread evenly over the sphere (Fibonacci lattice), each with its part of the soft light: a
/// bright sky above, less light from below; an upward surface in the open receives 1 in all.
std::vector<Eigen::Vector4f> make_ambient_light(int count) {
  std::vector<Eigen::Vector4f> light;
  double upward = 0.0;
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / count;
    const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i, r = std::sqrt(1.0 - z * z);
    const double strength = 0.35 + 0.65 * std::clamp((z + 0.2) / 0.5, 0.0, 1.0);
    light.push_back(Eigen::Vector4d(r * std::cos(angle), r * std::sin(angle), z, strength).cast<float>());
    upward += strength * std::max(z, 0.0);
  }
  for (Eigen::Vector4f& l : light) l.w() = static_cast<float>(l.w() / upward);
  return light;
}

Eigen::Matrix4d make_view_projection(const Camera& camera, double aspect, double near, double far) {
  const Mat3 axes = camera_axes(camera);
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.topLeftCorner<3, 3>() = axes.transpose();
  view.topRightCorner<3, 1>() = -axes.transpose() * camera.eye;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  if (camera.parallel_height > 0.0) {
    projection(1, 1) = 2.0 / camera.parallel_height;
    projection(0, 3) = camera.shift_right;
    projection(2, 2) = -2.0 / (far - near);
    projection(2, 3) = -(far + near) / (far - near);
    projection(3, 3) = 1.0;
  } else {
    projection(1, 1) = 1.0 / std::tan(0.5 * camera.field_of_view);
    projection(0, 2) = -camera.shift_right;
    projection(2, 2) = -(far + near) / (far - near);
    projection(2, 3) = -2.0 * far * near / (far - near);
    projection(3, 2) = -1.0;
  }
  projection(0, 0) = projection(1, 1) / aspect;
  return projection * view;
}

/// Nearest and farthest depth of a sphere [m], the near plane kept in front of the eye.
std::pair<double, double> depth_range(const Camera& camera, const Vec3& centre, double radius) {
  const double depth = (camera.eye - centre).dot(camera_axes(camera).col(2));
  const double far = depth + radius;
  if (camera.parallel_height > 0.0) return {depth - radius, far};
  const double safe_far = std::max(far, 1e-3);
  return {std::max(depth - radius, 0.02 * safe_far), safe_far};
}

void make_depth_texture(GLenum target, GLuint name, int size) {
  glBindTexture(target, name);
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(target, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(target, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  // Outside the picture nothing casts a shadow.
  const float lit[] = {1.0F, 1.0F, 1.0F, 1.0F};
  glTexParameterfv(target, GL_TEXTURE_BORDER_COLOR, lit);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  if (target == GL_TEXTURE_2D_ARRAY) {
    glTexImage3D(target, 0, GL_DEPTH_COMPONENT32F, size, size, shaders::kMaxAmbientDirections, 0,
                 GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  } else {
    glTexImage2D(target, 0, GL_DEPTH_COMPONENT32F, size, size, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  }
}

}  // namespace

/// One thing to draw.
struct ClothPainter::Part {
  GpuMesh mesh;
  Kind kind;
  Colour face, back;
  double thread_spacing = 0.0;
  bool mapped = false;
  YarnItem yarns{};
  std::shared_ptr<const Image> texture{};
  double texture_width = 0.0;
  bool casts_shadow() const { return kind == kCloth || kind == kObstacle; }
};

/// What there is to draw, and how large it is.
struct ClothPainter::Stage {
  Bounds casters;     // all that casts a shadow
  Bounds everything;  // with arrows and ground
  double arrow_radius = 0.0;
  Vec3 ground_centre = Vec3::Zero();
  double ground_size = 0.0;
  std::vector<Part> parts;  // the ground last, because it is blended

  explicit Stage(const ClothPicture& picture)
      : casters(bounds_of(picture, false)), everything(bounds_of(picture)) {
    if (casters.empty()) casters.include(picture.camera.target);
    everything.include(casters.centre());
    arrow_radius = 0.008 * (everything.high - everything.low).norm();
    const ColourBar* bar = picture.colour_bar ? &*picture.colour_bar : nullptr;
    for (const BoxItem& box : picture.boxes)
      parts.push_back({GpuMesh(make_draw_mesh(box)), kObstacle, box.colour, box.colour});
    for (const CylinderItem& c : picture.cylinders)
      parts.push_back({GpuMesh(make_draw_mesh(c)), kObstacle, c.colour, c.colour});
    for (const ClothItem& cloth : picture.cloths)
      parts.push_back({GpuMesh(make_draw_mesh(cloth, bar)), kCloth, cloth.face_colour, cloth.back_colour,
                       cloth.thread_spacing, bar != nullptr && !cloth.mesh.values.empty(), cloth.yarns,
                       cloth.texture, cloth.texture_width});
    for (const ArrowItem& arrow : picture.arrows) {
      const double radius = arrow.radius > 0.0 ? arrow.radius : arrow_radius;
      parts.push_back({GpuMesh(make_draw_mesh(arrow, radius)), kArrow, arrow.colour, arrow.colour});
    }
    if (picture.ground.shown) add_ground(picture.ground);
  }

  void add_ground(const GroundItem& ground) {
    ground_centre = casters.centre();
    ground_centre.z() = ground.height;
    const double extent = (casters.high - casters.low).norm();
    ground_size = ground.size > 0.0 ? ground.size : std::max(3.0 * extent, 0.1);
    everything.include(ground_centre - 0.5 * ground_size * Vec3(1.0, 1.0, 0.0));
    everything.include(ground_centre + 0.5 * ground_size * Vec3(1.0, 1.0, 0.0));
    parts.push_back(
        {GpuMesh(make_ground_mesh(ground_centre, ground_size)), kGround, ground.colour, ground.colour});
  }

  /// Radius of a sphere around everything, heads of arrows included [m].
  double view_radius() const {
    return 0.51 * (everything.high - everything.low).norm() + 8.0 * arrow_radius + 1e-3;
  }
};

/// The lights of one picture, and the sphere around all casters in which their depths are measured.
struct ClothPainter::Light {
  Eigen::Vector4d casters;  // centre, radius [m]
  std::vector<Eigen::Vector4f> ambient;
  Vec3 key, fill;

  Light(const ClothPicture& picture, const Bounds& bounds)
      : ambient(
            make_ambient_light(std::clamp(picture.ambient_directions, 8, shaders::kMaxAmbientDirections))) {
    casters << bounds.centre(), std::max(0.51 * (bounds.high - bounds.low).norm(), 1e-4);
    // From the upper left of the viewer, so that folds that run towards the viewer have a bright and a dark
    // side.
    const Mat3 axes = camera_axes(picture.camera);
    key = (-0.58 * axes.col(0) + 0.50 * axes.col(2) + 0.68 * Vec3::UnitZ()).normalized();
    fill = (0.60 * axes.col(0) + 0.60 * axes.col(2) + 0.20 * Vec3::UnitZ()).normalized();
  }
};

ClothPainter::ClothPainter()
    : depth_program_(shaders::kDepthVertex, shaders::kDepthFragment),
      surface_program_(shaders::kSurfaceVertex, shaders::kSurfaceFragment) {
  make_depth_texture(GL_TEXTURE_2D_ARRAY, ambient_depth_.name(), kAmbientSize);
  make_depth_texture(GL_TEXTURE_2D, key_depth_.name(), kKeySize);
}

void ClothPainter::set_colour_map(const ColourBar& bar) {
  std::vector<std::uint8_t> table;
  for (int i = 0; i < kColourMapSize; ++i) {
    const Colour c = sample_colour_map(bar.map, static_cast<double>(i) / (kColourMapSize - 1));
    for (double part : {c.red, c.green, c.blue})
      table.push_back(static_cast<std::uint8_t>(std::lround(255.0 * part)));
  }
  glBindTexture(GL_TEXTURE_2D, colour_map_.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8, kColourMapSize, 1, 0, GL_RGB, GL_UNSIGNED_BYTE, table.data());
}

void ClothPainter::set_texture(const std::shared_ptr<const Image>& image) {
  if (image == texture_image_) return;
  texture_image_ = image;
  glActiveTexture(GL_TEXTURE0 + kTextureUnit);
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image->width, image->height, 0, GL_RGBA, GL_UNSIGNED_BYTE,
               image->pixels.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glActiveTexture(GL_TEXTURE0);
}

void ClothPainter::paint_depths(const std::vector<Part>& parts, const Light& light) {
  glBindFramebuffer(GL_FRAMEBUFFER, depth_framebuffer_.name());
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  depth_program_.use();
  depth_program_.set("caster_sphere", light.casters);
  const auto paint = [&](const Vec3& direction, int size) {
    glViewport(0, 0, size, size);
    glClear(GL_DEPTH_BUFFER_BIT);
    depth_program_.set("direction", direction);
    for (const Part& part : parts) {
      if (part.casts_shadow()) part.mesh.draw();
    }
  };
  for (std::size_t i = 0; i < light.ambient.size(); ++i) {
    glFramebufferTextureLayer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, ambient_depth_.name(), 0,
                              static_cast<GLint>(i));
    paint(light.ambient[i].head<3>().cast<double>(), kAmbientSize);
  }
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, key_depth_.name(), 0);
  paint(light.key, kKeySize);
}

void ClothPainter::set_light(const Light& light) const {
  const GlProgram& p = surface_program_;
  p.set("caster_sphere", light.casters);
  p.set("ambient_count", static_cast<int>(light.ambient.size()));
  p.set("ambient_light", light.ambient);
  p.set("ambient_depth", kAmbientUnit);
  p.set("key_direction", light.key);
  p.set("fill_direction", light.fill);
  p.set("key_depth", kKeyUnit);
  p.set("key_texel", 1.0 / kKeySize);
  p.set("colour_map", kColourMapUnit);
  p.set("cloth_texture", kTextureUnit);
  // Off the surface by a few texels (2 R / size each), so that a surface does not shade itself.
  p.set("ambient_offset", 2.0 * light.casters.w() / kAmbientSize);
  p.set("key_offset", 7.0 * light.casters.w() / kKeySize);
  glActiveTexture(GL_TEXTURE0 + kAmbientUnit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, ambient_depth_.name());
  glActiveTexture(GL_TEXTURE0 + kKeyUnit);
  glBindTexture(GL_TEXTURE_2D, key_depth_.name());
  glActiveTexture(GL_TEXTURE0 + kColourMapUnit);
  glBindTexture(GL_TEXTURE_2D, colour_map_.name());
  glActiveTexture(GL_TEXTURE0 + kTextureUnit);
  glBindTexture(GL_TEXTURE_2D, texture_.name());
  glActiveTexture(GL_TEXTURE0);
}

void ClothPainter::paint_part(const Part& part) {
  surface_program_.set("kind", static_cast<int>(part.kind));
  surface_program_.set_colour("face_colour", part.face);
  surface_program_.set_colour("back_colour", part.back);
  surface_program_.set("thread_spacing", part.thread_spacing);
  surface_program_.set("mapped", part.mapped ? 1 : 0);
  surface_program_.set("structure", static_cast<int>(part.yarns.structure));
  surface_program_.set("yarn_pitch",
                       part.mapped ? Vec2(0.0, 0.0) : Vec2(part.yarns.warp_pitch, part.yarns.weft_pitch));
  const bool pictured = part.texture && !part.mapped;
  if (pictured) set_texture(part.texture);
  const double height = pictured ? part.texture_width * part.texture->height / part.texture->width : 0.0;
  surface_program_.set("texture_size", Vec2(pictured ? part.texture_width : 0.0, height));
  // Cloth that lies on an obstacle is drawn in front of it, and obstacles in front of the ground.
  if (part.kind == kCloth || part.kind == kArrow) {
    glDisable(GL_POLYGON_OFFSET_FILL);
  } else {
    glEnable(GL_POLYGON_OFFSET_FILL);
    const float push = part.kind == kGround ? 2.0F : 1.0F;
    glPolygonOffset(push, 4.0F * push);
  }
  // Only the outer side of closed bodies; cloth has two sides.
  if (part.kind == kObstacle) {
    glEnable(GL_CULL_FACE);
  } else {
    glDisable(GL_CULL_FACE);
  }
  part.mesh.draw();
}

void ClothPainter::paint_surfaces(const ClothPicture& picture, const Stage& stage, double aspect) {
  const Camera& camera = picture.camera;
  const auto [near, far] = depth_range(camera, stage.everything.centre(), stage.view_radius());
  const bool parallel = camera.parallel_height > 0.0;
  Eigen::Vector4d eye;
  eye << (parallel ? Vec3(camera_axes(camera).col(2)) : camera.eye), (parallel ? 0.0 : 1.0);
  const GlProgram& p = surface_program_;
  p.set("eye", eye);
  p.set("view_projection", make_view_projection(camera, aspect, near, far));
  p.set_colour("warp_colour", yarn_colour(Direction::kWarp));
  p.set_colour("weft_colour", yarn_colour(Direction::kWeft));
  p.set_colour("unknown_colour", kNoValueColour);
  p.set("ground_shape", Eigen::Vector4d(stage.ground_centre.x(), stage.ground_centre.y(),
                                        0.5 * stage.ground_size, picture.ground.grid));
  for (const Part& part : stage.parts) paint_part(part);
  glBindVertexArray(0);
}

void ClothPainter::paint(const ClothPicture& picture, GLuint framebuffer, int width, int height) {
  const Stage stage(picture);
  const Light light(picture, stage.casters);

  // Phases 1 and 2: depths along the lights.
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glDisable(GL_POLYGON_OFFSET_FILL);
  paint_depths(stage.parts, light);
  if (picture.colour_bar) set_colour_map(*picture.colour_bar);

  // Phase 3: the surfaces over the background.
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glViewport(0, 0, width, height);
  const Colour& back = picture.background;
  const auto premultiplied = [&](double part) {
    return static_cast<float>(srgb_to_linear(part) * back.alpha);
  };
  glClearColor(premultiplied(back.red), premultiplied(back.green), premultiplied(back.blue),
               static_cast<float>(back.alpha));
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_BLEND);
  glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  surface_program_.use();
  set_light(light);
  paint_surfaces(picture, stage, static_cast<double>(width) / height);
}

}  // namespace fuai
