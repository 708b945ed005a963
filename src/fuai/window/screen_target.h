// What the window shows before it is shown: one image, drawn in tiles, with the panels over it.
// SPDX-License-Identifier: Apache-2.0
//
//   tile (multisampled) --resolve--> screen --panels over it--> window, screenshot, video
//
//   Pictures never depend on what the window system does with its own buffers.
#pragma once

#include <optional>

#include "fuai/picture/gl_target.h"

namespace fuai {

/// A part of the screen, pixels from its upper left corner.
struct ScreenTile {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Thread class: the window's, on the thread of the current OpenGL 3.3 context.
class ScreenTarget {
 public:
  /// @param samples a pixel, 0: none @throws Error (kNoDevice) when the driver refuses
  void resize(int width, int height, int samples);
  int width() const { return screen_->width(); }
  int height() const { return screen_->height(); }

  /// Where a tile is to be drawn, at (0, 0) and of the tile's size. @throws as resize()
  GLuint begin_tile(const ScreenTile& tile);
  /// Takes the mean of its samples over to the screen.
  void end_tile(const ScreenTile& tile);
  /// The screen itself, for the panels.
  GLuint screen() const { return screen_->name(); }
  /// Copies the screen to the window's buffer.
  void show(int window_width, int window_height) const;
  /// A part of the screen as it is; alpha is kept.
  Image read(const ScreenTile& tile) const;
  Image read() const { return read({0, 0, width(), height()}); }

 private:
  int samples_ = 0;
  std::optional<GlTarget> screen_, tile_;
};

}  // namespace fuai
