// Makes frame buffers and reads them.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/gl_target.h"

#include <algorithm>
#include <string>

#include "fuai/core/error.h"

namespace fuai {

GlTarget::GlTarget(int width, int height, int samples) : width_(width), height_(height) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  const auto storage = [&](const GlRenderbuffer& buffer, GLenum format, GLenum attachment) {
    glBindRenderbuffer(GL_RENDERBUFFER, buffer.name());
    glRenderbufferStorageMultisample(GL_RENDERBUFFER, std::min<int>(samples, most), format, width, height);
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

void resolve(const GlTarget& from, const GlTarget& to, int left, int low) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from.name());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to.name());
  glBlitFramebuffer(0, 0, from.width(), from.height(), left, low, left + from.width(), low + from.height(),
                    GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

Image read_pixels(const GlTarget& target, int left, int low, int width, int height) {
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> bytes(row * static_cast<std::size_t>(height));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, target.name());
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(left, low, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  const GLenum error = glGetError();
  if (error != GL_NO_ERROR)
    throw Error(ErrorKind::kNoDevice, "the graphics driver reports OpenGL error " + std::to_string(error));
  Image image{width, height, std::vector<std::uint8_t>(bytes.size())};
  for (int y = 0; y < height; ++y)
    std::copy_n(bytes.data() + static_cast<std::size_t>(height - 1 - y) * row, row, image.at(0, y));
  return image;
}

}  // namespace fuai
