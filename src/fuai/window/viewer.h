// The viewer: a window, or the same without a display, in which cloths are seen, grabbed and compared.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md.
//
//   window's thread                              cloth's thread
//     events -> panels -> commands  ---------->  ViewSession::tick() every millisecond
//     pictures of the newest snapshot <--------
//
//   With a number of seconds, and without a display, the window's thread ticks the cloths itself, a picture's
//   time at a time: what is seen then depends on nothing but the options.
//   With a device its hand brings a force loop along, and ticks the session (device_hand.h).
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "fuai/scenes/engine_scene.h"
#include "fuai/window/kept_settings.h"

namespace fuai {

/// What to show, and how.
struct ViewerOptions {
  std::string scene = "hanging_sheet";
  std::vector<std::string> fabrics;  ///< 1 to kMostViewFabrics, as load_fabric() takes them
  SceneOptions size;
  ViewSettings settings;
  int width = 1280, height = 720;  ///< [pixel]
  bool window = true;              ///< else without a display
  bool scene_moves = false;        ///< the scene's own hands and pins move
  double seconds = 0.0;            ///< simulated time after which it ends [s]; 0: until it is closed
  std::string device;              ///< "driver" or "driver:model"; empty or "mouse": the mouse alone
  std::size_t felt = 0;            ///< number of the cloth that the device feels
  bool rumble = false;             ///< a gamepad rumbles with the force on the hand of the user
  bool sound = false;              ///< a tone follows that force
  double zoom = 1.0;               ///< how many times nearer than where everything is seen
  std::string texture;             ///< PNG that lies on the cloths; what is wrong with it is told by `say`
  double texture_width = 0.1;      ///< width of that picture on the cloth [m]
  KeptSettings kept;               ///< as they were read
  std::string settings_file;       ///< where settings are kept at the end; empty: nowhere
  std::string screenshot;          ///< PNG written at the end
  std::string replay;              ///< recording that is done again; it brings scene and fabrics
  std::string record;              ///< recording written from the start
  std::string folder = ".";        ///< where pictures, videos and logs go
  std::string version;             ///< of the program, for captions
  std::function<void(const std::string&)> say;  ///< one clear line about what is missing
  const std::atomic<bool>* stop = nullptr;      ///< ends it as if the window were closed; null: nobody does
};

/// A force as it is written beside a hand.
struct ShownForce {
  std::size_t cloth = 0;
  std::string hand;  ///< a number, or "scene 0"
  std::string text;  ///< "118.3 mN   12.06 gf"
};

/// A line that the window said.
struct SaidMessage {
  std::string text;  ///< in its language then
  bool bad = false;
};

/// What happened.
struct ViewerResult {
  double seconds = 0.0;               ///< simulated [s]
  std::int64_t pictures = 0;          ///< painted
  std::int64_t paused_pictures = 0;   ///< of them, while time stood
  std::uint64_t state_hash = 0;       ///< of all cloths at the end
  double picture_ms = 0.0;            ///< median time from picture to picture [ms]
  double paint_ms = 0.0;              ///< median time for the cloths of a picture [ms]
  std::string renderer;               ///< as the driver calls itself
  std::string device;                 ///< model; empty: the mouse alone
  std::vector<ShownForce> forces;     ///< in the last picture
  std::vector<SaidMessage> messages;  ///< the newest hundred, oldest first
  std::uint64_t overruns = 0;         ///< of its force loop
  double device_force = 0.0;          ///< most that was sent to it [N]
  std::int64_t replay_hashes = 0;     ///< compared with those of a recording; 0: there was none
  bool replay_matches = false;        ///< all of them
};

/// Whether there is a display to open a window on. Thread class: set-up.
bool has_display();

/// Runs until the window is closed or the seconds are over. @throws Error (kNoDevice) without a display or a
/// graphics driver; as make_view_setup(); (kUsage) for a driver that does not
/// exist, and a real device in computed time; (kBadInput) for files that cannot be written, and a recording
/// that cannot be read. Thread class:
/// set-up.
ViewerResult run_viewer(const ViewerOptions& options);

}  // namespace fuai
