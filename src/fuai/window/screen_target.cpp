// The screen and the tile that is being drawn.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/screen_target.h"

namespace fuai {

void ScreenTarget::resize(int width, int height, int samples) {
  if (screen_ && width == screen_->width() && height == screen_->height() && samples == samples_) return;
  samples_ = samples;
  tile_.reset();
  screen_.emplace(width, height, 0);
}

GLuint ScreenTarget::begin_tile(const ScreenTile& tile) {
  if (!tile_ || tile_->width() != tile.width || tile_->height() != tile.height)
    tile_.emplace(tile.width, tile.height, samples_);
  return tile_->name();
}

void ScreenTarget::end_tile(const ScreenTile& tile) {
  resolve(*tile_, *screen_, tile.left, height() - tile.top - tile.height);  // rows count from below
}

void ScreenTarget::show(int window_width, int window_height) const {
  // Both sides hold encoded colours: the copy is not to convert them.
  glDisable(GL_FRAMEBUFFER_SRGB);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, screen());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, width(), height(), 0, 0, window_width, window_height, GL_COLOR_BUFFER_BIT,
                    width() == window_width ? GL_NEAREST : GL_LINEAR);
}

Image ScreenTarget::read(const ScreenTile& tile) const {
  return read_pixels(*screen_, tile.left, height() - tile.top - tile.height, tile.width, tile.height);
}

}  // namespace fuai
