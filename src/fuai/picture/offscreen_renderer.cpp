// Frame buffers of the off-screen renderer and the way of the pixels back to memory.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/offscreen_renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "fuai/core/error.h"
#include "fuai/picture/cloth_painter.h"
#include "fuai/picture/egl_context.h"
#include "fuai/picture/overlay.h"

namespace fuai {
namespace {

constexpr int kSamples = 4;

/// Colour and depth of one size.
class Target {
 public:
  Target(int width, int height, int samples) {
    const auto storage = [&](const GlRenderbuffer& buffer, GLenum format, GLenum attachment) {
      glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer.name());
    };
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
    storage(colour_, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
    storage(depth_, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
    const GLenum status = glCheckFramebufferStatus(GL_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
      throw Error(ErrorKind::kNoDevice, "the graphics driver refuses a frame buffer of " +
                                            std::to_string(width) + " x " + std::to_string(height) +
                                            " pixels (status " + std::to_string(status) + ")");
  }
  GLuint name() const { return framebuffer_.name(); }

 private:
  GlFramebuffer framebuffer_;
  GlRenderbuffer colour_, depth_;
};

/// Rows from the top and straight alpha instead of rows from the bottom and colour that was multiplied by
/// alpha in linear light.
Image to_image(const std::vector<std::uint8_t>& bytes, int width, int height) {
  std::array<double, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<double>(i) / 255.0);
  Image image{width, height, std::vector<std::uint8_t>(bytes.size())};
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = bytes.data() + static_cast<std::size_t>(height - 1 - y) * row;
    std::uint8_t* to = image.at(0, y);
    for (std::size_t i = 0; i < row; i += 4) {
      const std::uint8_t alpha = to[i + 3] = from[i + 3];
      for (std::size_t k = i; k < i + 3; ++k) {
        to[k] = from[k];
        if (alpha > 0 && alpha < 255) {
          const double straight = std::min(1.0, linear[from[k]] * 255.0 / alpha);
          to[k] = static_cast<std::uint8_t>(std::lround(255.0 * linear_to_srgb(straight)));
        }
      }
    }
  }
  return image;
}

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
  GLint samples = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &samples);
  const Target many(width, height, std::min(samples, kSamples)), one(width, height, 0);
  parts_->painter.paint(picture, many.name(), width, height);

  // Mean of the samples, then back to memory.
  glBindFramebuffer(GL_READ_FRAMEBUFFER, many.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, one.name());
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, one.name());
  std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  const GLenum error = glGetError();
  if (error != GL_NO_ERROR)
    throw Error(ErrorKind::kNoDevice, "the graphics driver reports OpenGL error " + std::to_string(error));
  return draw_overlay(to_image(bytes, width, height), picture);
}

}  // namespace fuai
