// Where the window is seen: its host, its fonts, and the pictures of the cloths under the panels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "fuai/picture/cloth_painter.h"
#include "fuai/window/screen_target.h"
#include "fuai/window/viewer.h"
#include "fuai/window/viewer_host.h"
#include "fuai/window/viewer_state.h"

namespace fuai {

/// How much light a driver can afford in every picture.
struct PictureQuality {
  int samples = 4, ambient_directions = 32;
};

/// The screen. Thread class: the window's.
class ViewerScreen {
 public:
  /// Opens the host, sets the scale of the state, loads fonts and theme; what is missing is told by
  /// `options.say`. @throws Error (kNoDevice) without a display or a graphics driver.
  ViewerScreen(const ViewerOptions& options, ViewerState& state);

  ViewerHost& host() noexcept { return *host_; }
  ScreenTarget& target() noexcept { return target_; }
  ClothPainter& painter() noexcept { return *painter_; }
  /// As the driver calls itself.
  const std::string& renderer() const noexcept { return renderer_; }
  /// Letters and all that goes with them take the size of the settings; not within a frame of ImGui.
  void rescale(ViewerState& state);
  /// The target takes the size of the host.
  void resize();
  /// The cloths into their tiles, and what ImGui has to draw over them.
  void paint(const ViewerState& state);
  /// The picture of what was painted last, opaque.
  Image read() const;
  /// Times that the pictures took, the newest of them [ms].
  const std::vector<double>& paint_times() const noexcept { return paint_times_; }

 private:
  std::string take_scale(ViewerState& state);

  std::unique_ptr<ViewerHost> host_;
  std::string renderer_;
  PictureQuality quality_;
  std::unique_ptr<ClothPainter> painter_;
  ScreenTarget target_;
  std::vector<double> paint_times_;
};

/// Of how many times the newest are kept.
inline constexpr std::size_t kMostPictureTimes = 20000;

}  // namespace fuai
