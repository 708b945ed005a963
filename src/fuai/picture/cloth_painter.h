// Draws a ClothPicture with OpenGL into the frame buffer that is bound, without its text.
//
// One picture is drawn in three phases:
//   1. depth of the casters seen along each direction of the soft light (a texture array),
//   2. depth of the casters seen along the key light (one finer texture),
//   3. the surfaces: soft light at the vertices, key light, weave lines, yarns and colours at the pixels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "fuai/picture/cloth_picture.h"
#include "fuai/picture/gl_object.h"
#include "fuai/picture/gl_program.h"

namespace fuai {

/// Thread class: set-up, on the thread of the current OpenGL 3.3 context; deleted while that is current.
class ClothPainter {
 public:
  ClothPainter();

  /// Clears the bound frame buffer (sRGB colour, depth) and draws. The colour is premultiplied by alpha in
  /// linear light. @param framebuffer to bind for the last phase; @param width, height [pixel]
  void paint(const ClothPicture& picture, GLuint framebuffer, int width, int height);

 private:
  struct Part;
  struct Stage;
  struct Light;

  void paint_depths(const std::vector<Part>& parts, const Light& light);
  void paint_part(const Part& part);
  void paint_surfaces(const ClothPicture& picture, const Stage& stage, double aspect);
  void set_light(const Light& light) const;
  void set_colour_map(const ColourBar& bar);
  void set_texture(const std::shared_ptr<const Image>& image);

  GlProgram depth_program_, surface_program_;
  GlTexture ambient_depth_, key_depth_, colour_map_, texture_;
  std::shared_ptr<const Image> texture_image_;  // what texture_ holds
  GlFramebuffer depth_framebuffer_;
};

}  // namespace fuai
