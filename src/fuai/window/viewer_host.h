// Where the viewer runs: a window of the display, or nothing but a graphics driver.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "fuai/window/key_table.h"
#include "fuai/window/screen_target.h"

namespace fuai {

/// Pictures a second of most screens.
inline constexpr double kUsualRate = 60.0;

/// What a button of the mouse did between two pictures.
struct ButtonTrail {
  int presses = 0;                                  ///< two are a double click
  bool let_go = false;                              ///< after the last of them
  std::array<double, 2> pressed_at{}, let_go_at{};  ///< the last time [pixel]
};
inline constexpr std::size_t kMouseButtons = 3;  ///< left, right, middle, as GLFW and ImGui count them

/// Makes an OpenGL context current and feeds ImGui. One at a time. Thread class: set-up, one thread.
class ViewerHost {
 public:
  ViewerHost() = default;
  ViewerHost(const ViewerHost&) = delete;
  ViewerHost& operator=(const ViewerHost&) = delete;
  virtual ~ViewerHost() = default;

  /// Waits until something happens to the window, but no longer than this. @param seconds [s]
  virtual void wait(double /*seconds*/) {}
  /// Whether something happened to it since the last call, at once or while it was waited for.
  virtual bool take_happened() { return true; }
  /// Whether anybody could see it.
  virtual bool visible() const { return false; }
  /// Pictures that its screen shows a second; kUsualRate where nobody knows.
  virtual double rate() const { return kUsualRate; }
  /// Events, sizes and times of a new frame, to ImGui; before ImGui::NewFrame().
  virtual void begin_frame() = 0;
  /// Shows what was drawn.
  virtual void show(const ScreenTarget& target) = 0;
  virtual bool closing() const = 0;
  virtual int width() const = 0;  ///< [pixel]
  virtual int height() const = 0;
  virtual float scale() const = 0;   ///< of the screen, 1 at 96 dpi
  virtual double clock() const = 0;  ///< [s]
  virtual void toggle_full_screen() {}
  /// Keys that were pressed since the last call. Not asked from ImGui, which looks once a picture: a key that
  /// was pressed and let go between two pictures counts.
  virtual std::vector<KeyPress> take_keys() { return {}; }
  /// What the buttons did since the last call: by the next picture the cursor may be elsewhere.
  virtual std::array<ButtonTrail, kMouseButtons> take_buttons() { return {}; }
  /// Paths that were dropped on it since the last call.
  virtual std::vector<std::string> take_dropped() { return {}; }
};

/// The scale that is told, or where none is told (1) that of a fine screen by its size. @param told by the
/// system @param pixels, millimetres of the screen's width; what cannot be is not believed. Thread class:
/// any.
float fitting_scale(float told, int pixels, int millimetres);

/// @throws Error (kNoDevice) without a display. Thread class: set-up.
std::unique_ptr<ViewerHost> make_window_host(int width, int height, const std::string& title);
/// A frame lasts 1 / kUsualRate. @throws Error (kNoDevice) without a graphics driver. Thread class: set-up.
std::unique_ptr<ViewerHost> make_headless_host(int width, int height);

}  // namespace fuai
