// A frame buffer with colour and depth to draw pictures into, and the way of its pixels to memory.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/picture/gl_object.h"
#include "fuai/picture/image.h"

namespace fuai {

/// Encoded colour with alpha, and depth. Thread class: set-up, on the context's thread.
class GlTarget {
 public:
  /// @param width, height [pixel] @param samples a pixel, 0: none; no more than the driver has are taken
  /// @throws Error (kNoDevice) when the driver refuses
  GlTarget(int width, int height, int samples);
  GLuint name() const { return framebuffer_.name(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  GlFramebuffer framebuffer_;
  GlRenderbuffer colour_, depth_;
  int width_, height_;
};

/// The mean of the samples of one target, to a place of another. @param left, low lower left corner [pixel]
void resolve(const GlTarget& from, const GlTarget& to, int left = 0, int low = 0);

/// A part of a target without samples, rows from the top, alpha as it was drawn.
/// @param left, low lower left corner [pixel] @throws Error (kNoDevice) when the driver reports an error
Image read_pixels(const GlTarget& target, int left, int low, int width, int height);

}  // namespace fuai
