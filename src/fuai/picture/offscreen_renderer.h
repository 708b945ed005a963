// Renders pictures of cloth without a display.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "fuai/picture/cloth_picture.h"
#include "fuai/picture/image.h"

namespace fuai {

/// An OpenGL context without a window. Making one takes a moment, so use it for many pictures.
/// Thread class: set-up; made, used and deleted on one thread.
class OffscreenRenderer {
 public:
  OffscreenRenderer(OffscreenRenderer&&) noexcept;
  OffscreenRenderer& operator=(OffscreenRenderer&&) noexcept;
  ~OffscreenRenderer();

  /// Draws the picture with its text; the same picture gives the same bytes on the same driver.
  /// @param width, height [pixel], 16 to the driver's limit
  /// Throws Error kUsage for an impossible size, mesh or colour bar, kCheckFailed for a position that is not
  /// finite, kNoDevice when the driver fails.
  Image render(const ClothPicture& picture, int width, int height);

 private:
  friend OffscreenRenderer make_offscreen_renderer();
  struct Parts;
  explicit OffscreenRenderer(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

/// Throws Error kNoDevice, with the driver's text and the packages that mend it, when there is no OpenGL 3.3
/// without a display or the library was built without pictures. Thread class: set-up.
OffscreenRenderer make_offscreen_renderer();

}  // namespace fuai
