// Everything the panels of the window share.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuai/cloth/piece_mesh.h"
#include "fuai/laboratory/fabric_comparison.h"
#include "fuai/laboratory/fabric_numbers.h"
#include "fuai/viewer/view_log.h"
#include "fuai/viewer/view_session.h"
#include "fuai/window/device_hand.h"
#include "fuai/window/error_text.h"
#include "fuai/window/fabric_choice.h"
#include "fuai/window/first_steps.h"
#include "fuai/window/hand_book.h"
#include "fuai/window/key_table.h"
#include "fuai/window/orbit_camera.h"
#include "fuai/window/screen_target.h"
#include "fuai/window/ui_text.h"
#include "fuai/window/view_document.h"
#include "fuai/window/view_quantity.h"
#include "fuai/window/view_settings.h"
#include "fuai/window/viewer.h"
#include "fuai/window/viewer_host.h"

namespace fuai {

/// The scene's own first hand, as the plots number hands: behind those of the user.
inline constexpr int kSceneHand = static_cast<int>(kMostViewHands);

/// A moment of the force plots.
struct ForceMoment {
  double time = 0.0;               ///< [s]
  double way = 0.0;                ///< of the hand from where it gripped [m]
  int hand = -1;                   ///< of the user, a device or a recording, or kSceneHand; -1: none
  std::vector<double> forces;      ///< pull of the hand, by cloth [N]
  std::vector<ClothProbe> probes;  ///< by cloth
  bool probed = false;
};

/// A line that goes away by itself.
struct Message {
  std::string text;
  bool bad = false;
  double until = 0.0;  ///< clock of the window [s]
};

/// Of how many messages the newest are remembered.
inline constexpr std::size_t kMostSaid = 100;

/// What the user holds besides the mouse.
struct ShownDevice {
  std::string asked;  ///< empty: nothing
  std::string model;  ///< empty: it is not there
  bool gives_force = false;
  DeviceView view;
};

/// A recording that is done again.
struct ShownReplay {
  std::string name;  ///< of its file
  std::vector<ViewLogPart> parts;
  std::int64_t end = 0;  ///< last tick of all, as the recording counts
  bool begun = false, over = false;
  std::size_t part = 0;                        ///< under way
  std::int64_t last_tick = 0;                  ///< of this part
  std::uint64_t build = 0;                     ///< of the session, that the part is
  std::int64_t tick = 0;                       ///< where it is, as the recording counts
  std::int64_t end_tick = 0;                   ///< of the session when it was over
  std::int64_t hashes = 0, hashes_before = 0;  ///< compared in all, and by earlier parts
  std::int64_t first_difference = -1;          ///< as the recording counts; -1: none
};

/// The list to choose a fabric from.
struct ShownChoice {
  std::vector<FabricChoice> fabrics;  ///< bundled; empty until it is opened
  char text[64] = {};                 ///< searched
  ChoiceColumn by = ChoiceColumn::kName;
  bool descending = false;
};

/// What the pressed button does.
struct Drag {
  enum class Kind : std::uint8_t { kNone, kHand, kOrbit, kPan };
  Kind kind = Kind::kNone;
  int hand = -1;
  std::size_t tile = 0;
  bool stays = false;      ///< the grab stays when the button is let go
  std::size_t button = 0;  ///< as the host counts them
  bool let_go = false;     ///< it was already, within the picture in which it was pressed
};

/// What a frame wants done when it is over. Of what is counted every picture does one: a key that was pressed
/// twice between two pictures begins a video with the one and ends it with the next.
struct ViewWishes {
  bool quit = false, obj = false, gltf = false, force_log = false, new_theme = false, new_scale = false;
  int full_screen = 0, screenshot = 0, video = 0, record = 0, save = 0;
  std::optional<std::string> open;  ///< path

  /// Whether some of what is counted waits for the next picture.
  bool any() const noexcept { return full_screen + screenshot + video + record + save > 0; }
  void one_done() noexcept;
};

/// The state.
struct ViewerState {
  ViewSettings settings;
  ViewDocument document;
  std::shared_ptr<ViewCloths> cloths;  ///< of the document's setup
  std::unique_ptr<ViewSession> session;
  std::vector<FabricLaws> laws;   ///< by fabric, with the factors
  std::vector<PieceMesh> meshes;  ///< by cloth, where the newest snapshot has them
  std::vector<std::vector<double>> vertex_values;
  std::vector<std::string> fabric_names;  ///< bundled

  std::vector<std::vector<FabricNumber>> numbers;  ///< by fabric, as measured
  std::optional<FabricComparison> comparison;      ///< when there are several

  std::shared_ptr<const Image> texture;  ///< of all cloths; may be empty
  double texture_width = 0.1;            ///< [m]

  HandBook hands;
  ShownDevice device;
  bool rumbles = false;  ///< a gamepad or a tone follows the force
  std::size_t felt = 0;  ///< number of the cloth that devices feel
  std::size_t page = 0;  ///< number of the fabric whose numbers are shown: files take and give this one
  std::optional<std::size_t> turn_to;  ///< page to be shown from the next picture on
  std::optional<ShownReplay> replay;
  ShownChoice choice;
  Drag drag;
  std::array<ButtonTrail, kMouseButtons> buttons;  ///< of the mouse, since the last picture
  OrbitCamera camera;
  std::vector<ScreenTile> tiles;  ///< by cloth, in pixels of the screen
  bool playing = true;
  std::deque<ForceMoment> forces;  ///< the last seconds
  Vec3 led_start = Vec3::Zero();   ///< where a hand that is not the mouse's gripped last [m]
  std::deque<Message> messages;
  std::deque<SaidMessage> said;          ///< the newest of all
  std::vector<ShownForce> shown_forces;  ///< in the last picture
  ViewWishes wishes;
  double clock = 0.0;                      ///< since the start of the window [s]
  std::optional<double> real_time_factor;  ///< of the last second; none: the cloths are not paced
  double picture_ms = 0.0;                 ///< time between pictures, smoothed
  bool recording = false, filming = false, logging = false;
  bool loops_near = false;  ///< the axes of the live loops reach as far as the cloth, else the instrument
  bool browsing = false;    ///< the file panel is open
  std::string browse_folder;
  std::uint64_t built_version = 0;  ///< of the document, that `cloths` were built for
  ViewSetup built;                  ///< that setup: what is seen; the document may be a change ahead
  FirstSteps steps;                 ///< of a newcomer

  explicit ViewerState(ViewSetup setup) : document(std::move(setup)) {}

  const char* text(TextId id) const { return ui_text(id, settings.language); }
  std::string text(const Error& error) const { return error_text(error, settings.language); }
  const ViewSnapshot& snapshot() const { return session->snapshot(); }
  /// Where the slots of a cloth are, as far as is known [m].
  const std::vector<Vec3>& slot_positions(std::size_t cloth) const;
  void say(std::string text, bool bad = false) {
    said.push_back({text, bad});
    if (said.size() > kMostSaid) said.pop_front();
    messages.push_back({std::move(text), bad, clock + (bad ? 12.0 : 5.0)});
  }
};

/// How many seconds the force plots show.
inline constexpr double kForceSeconds = 10.0;

/// The panels, each in a file of its own. They draw with ImGui and change the state. Thread class: the
/// window's.
void draw_menu(ViewerState& state);
void draw_fabric_panel(ViewerState& state);
void draw_plots_panel(ViewerState& state);
void draw_time_panel(ViewerState& state);
void draw_help(ViewerState& state);
void draw_browser(ViewerState& state);
void draw_comparison(ViewerState& state);
/// The list of fabrics, for a place of the table.
void draw_fabric_choice(ViewerState& state, std::size_t place);
/// Lines, arrows, forces, colour bar and captions over the cloths.
void draw_overlay_2d(ViewerState& state);
/// Mouse and keys that no panel wants.
void handle_mouse(ViewerState& state);
void handle_keys(ViewerState& state, const std::vector<KeyPress>& keys);
/// Does what a key or a menu entry asks for.
void act(ViewerState& state, KeyAction action);

/// A part of the window, pixels from its upper left corner.
struct ViewBox {
  float left = 0.0F, top = 0.0F, width = 0.0F, height = 0.0F;
};
/// Where the panels are, and what is left for the cloths.
struct ViewLayout {
  ViewBox fabric, plots, time, view;
};
ViewLayout lay_out(const ViewerState& state);
/// So many of these lines, from the first, fit over the cloths without hiding more of them than they may.
/// @param heights of the lines, each with all before it [pixel]
std::size_t lines_that_fit(const ViewBox& view, std::span<const float> heights);
/// ImGui::Begin() of a panel that fills a box; ImGui::End() follows whatever it returns.
bool begin_panel(const char* name, const ViewBox& box, bool scrolls);
/// The tiles of so many cloths in a box, as square as they can be.
std::vector<ScreenTile> make_tiles(const ViewBox& box, std::size_t count);

/// Where a point of the scene is in a tile [pixel of the screen]; depth in z, negative behind the eye.
Vec3 to_screen(const ViewerState& state, const ScreenTile& tile, const Vec3& point);
/// "B warp", the direction in the language of the window.
std::string number_name(const ViewerState& state, const FabricNumber& number);
/// Newtons and gram-force, always both: "0.123 N  12.5 gf".
std::string force_text(double newtons);

}  // namespace fuai
