// Frame buffers of the off-screen renderer and the way of the pixels back to memory.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/offscreen_renderer.h"

#include <string>

#include "fuai/core/error.h"
#include "fuai/picture/cloth_painter.h"
#include "fuai/picture/egl_context.h"
#include "fuai/picture/gl_target.h"
#include "fuai/picture/overlay.h"

namespace fuai {
namespace {

constexpr int kSamples = 4;

void check_picture(const ClothPicture& picture, int width, int height) {
  check_image_size(width, height);
  if (picture.colour_bar && !(picture.colour_bar->high > picture.colour_bar->low))
    throw Error(ErrorKind::kUsage, "the colour bar \"" + picture.colour_bar->title + "\" has no range");
  GLint most = 0;
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most);
  if (width > most || height > most)
    throw Error(ErrorKind::kUsage, "a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                                       " pixels is larger than the driver's " + std::to_string(most));
}

}  // namespace

struct OffscreenRenderer::Parts {
  EglContext context;
  ClothPainter painter;
  // The painter's objects are deleted in their own context, whichever was used last.
  ~Parts() { context.make_current(); }
};

OffscreenRenderer::OffscreenRenderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
OffscreenRenderer::OffscreenRenderer(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer& OffscreenRenderer::operator=(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer::~OffscreenRenderer() = default;

OffscreenRenderer make_offscreen_renderer() {
  return OffscreenRenderer(std::make_unique<OffscreenRenderer::Parts>());
}

Image OffscreenRenderer::render(const ClothPicture& picture, int width, int height) {
  parts_->context.make_current();
  check_picture(picture, width, height);
  const GlTarget many(width, height, kSamples), one(width, height, 0);
  parts_->painter.paint(picture, many.name(), width, height);
  resolve(many, one);
  Image image = read_pixels(one, 0, 0, width, height);
  make_alpha_straight(image);
  return draw_overlay(image, picture);
}

}  // namespace fuai
