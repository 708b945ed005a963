// What mouse and keys do to cloths, camera and time.
// SPDX-License-Identifier: Apache-2.0
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "fuai/window/cloth_picker.h"
#include "fuai/window/viewer_state.h"

namespace fuai {
namespace {

/// A hand is taken up again when the cursor is so near to it [pixel at scale 1].
constexpr double kNear = 14.0;
/// A notch of the wheel moves a grab by this part of its distance from the eye.
constexpr double kWheelStep = 0.02;

/// Buttons, as GLFW and ImGui number them.
constexpr std::size_t kLeft = 0, kRight = 1, kMiddle = 2;

Vec2 place_of(const std::array<double, 2>& pixel) { return {pixel[0], pixel[1]}; }

Vec2 mouse_place() {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  return {static_cast<double>(mouse.x), static_cast<double>(mouse.y)};
}

bool inside(const ScreenTile& tile, const Vec2& place) {
  return place.x() >= tile.left && place.x() < tile.left + tile.width && place.y() >= tile.top &&
         place.y() < tile.top + tile.height;
}

int tile_at(const ViewerState& state, const Vec2& place) {
  for (std::size_t i = 0; i < state.tiles.size(); ++i)
    if (inside(state.tiles[i], place)) return static_cast<int>(i);
  return -1;
}

double aspect_of(const ScreenTile& tile) { return static_cast<double>(tile.width) / tile.height; }

/// -1 to 1 from left to right and from bottom to top of a tile.
Vec2 place_in(const ScreenTile& tile, const Vec2& pixel) {
  return {2.0 * (pixel.x() - tile.left) / tile.width - 1.0, 1.0 - 2.0 * (pixel.y() - tile.top) / tile.height};
}

Ray ray_at(const ViewerState& state, std::size_t tile, const Vec2& pixel) {
  const ScreenTile& t = state.tiles[tile];
  return state.camera.ray(place_in(t, pixel), aspect_of(t));
}

/// The hand whose place is nearest to the cursor; -1: none is near.
int hand_near(const ViewerState& state, std::size_t tile, const Vec2& pixel) {
  int nearest = -1;
  double best = kNear * state.settings.scale;
  for (std::size_t i = 0; i < kMostViewHands; ++i) {
    const UserHand& hand = state.hands.hand(i);
    if (!hand.active) continue;
    const Vec3 at = to_screen(state, state.tiles[tile], hand.target);
    const double distance = (at.head<2>() - pixel).norm();
    if (at.z() > 0.0 && distance < best) {
      best = distance;
      nearest = static_cast<int>(i);
    }
  }
  return nearest;
}

std::optional<ClothHit> cloth_at(const ViewerState& state, std::size_t tile, const Vec2& pixel) {
  if (tile >= state.meshes.size()) return std::nullopt;
  return pick_cloth(state.meshes[tile].mesh, ray_at(state, tile, pixel));
}

void press_left(ViewerState& state, std::size_t tile, const Vec2& pixel, bool stays) {
  const int near = hand_near(state, tile, pixel);
  const std::optional<ClothHit> hit = cloth_at(state, tile, pixel);
  if (ImGui::IsMouseDoubleClicked(0) || state.buttons[kLeft].presses > 1) {
    if (near >= 0)
      state.hands.release(*state.session, near);
    else if (hit)
      state.hands.grab(*state.session, tile, hit->material, hit->point, true);
    return;
  }
  state.drag = {Drag::Kind::kOrbit, -1, tile, stays};
  if (near >= 0) {
    state.drag = {Drag::Kind::kHand, near, tile, true};
  } else if (hit) {
    const int hand = state.hands.grab(*state.session, tile, hit->material, hit->point, false);
    if (hand < 0) return;
    state.drag = {Drag::Kind::kHand, hand, tile, stays};
    state.forces.clear();
    state.steps.did(FirstStep::kGrab);
  }
}

void drag_hand(ViewerState& state, const Vec2& pixel, bool moved, double wheel) {
  const UserHand& hand = state.hands.hand(static_cast<std::size_t>(state.drag.hand));
  if (!hand.active) {
    state.drag = {};
    return;
  }
  const Vec3 forward = state.camera.forward();
  Vec3 target = hand.target;
  if (moved) target = meet_plane(ray_at(state, state.drag.tile, pixel), hand.target, forward);
  if (wheel != 0.0) {
    const Vec3 eye = state.camera.camera().eye;
    target += wheel * kWheelStep * (target - eye);
  }
  state.hands.move(*state.session, state.drag.hand, target);
}

/// The button was let go and pressed again between two pictures while it held: a double click.
void click_again(ViewerState& state) {
  const UserHand held = state.hands.hand(static_cast<std::size_t>(state.drag.hand));
  const bool pins = !held.pinned && !state.drag.stays;
  state.hands.release(*state.session, state.drag.hand);
  state.drag = {};
  if (pins) state.hands.grab(*state.session, held.cloth, held.material, held.target, true);
}

void drag_camera(ViewerState& state, const Vec2& move) {
  const double height = state.tiles[state.drag.tile].height;
  if (state.drag.kind == Drag::Kind::kOrbit) state.camera.orbit(move, height);
  if (state.drag.kind == Drag::Kind::kPan) state.camera.pan(move, height);
}

/// Where a drag went since the last picture: to the cursor, or to where the button was let go before.
Vec2 drag_end(const ViewerState& state, const Vec2& pixel) {
  const ButtonTrail& trail = state.buttons[state.drag.button];
  return trail.let_go ? place_of(trail.let_go_at) : pixel;
}

/// Which button was pressed; kMouseButtons: none.
std::size_t pressed_button() {
  for (const std::size_t button : {kMiddle, kRight, kLeft})
    if (ImGui::IsMouseClicked(static_cast<int>(button))) return button;
  return kMouseButtons;
}

/// What was pressed begins a drag. Between two slow pictures a quick hand goes far, and may be done already:
/// what it pressed counts, then where it went, as far as where it let go.
void press(ViewerState& state, std::size_t button, std::size_t tile, const Vec2& from, const Vec2& pixel) {
  const bool shift = ImGui::GetIO().KeyShift;
  if (button == kLeft)
    press_left(state, tile, from, shift);
  else
    state.drag = {button == kMiddle || shift ? Drag::Kind::kPan : Drag::Kind::kOrbit, -1, tile, false};
  if (state.drag.kind == Drag::Kind::kNone) return;
  state.drag.button = button;
  state.drag.let_go = state.buttons[button].let_go;
  const Vec2 to = drag_end(state, pixel);
  if (to == from) return;
  if (state.drag.kind == Drag::Kind::kHand)
    drag_hand(state, to, true, 0.0);
  else
    drag_camera(state, to - from);
}

/// The drag that goes on, and its end.
void drag_on(ViewerState& state, const Vec2& pixel, double wheel) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 delta(static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y));
  const Vec2 to = drag_end(state, pixel), move = to - (pixel - delta);
  Drag& drag = state.drag;
  // Let go with the picture before, the drag went where it went then, unless the button is down once more.
  if (state.buttons[drag.button].presses > 0) drag.let_go = false;
  if (!drag.let_go && drag.kind == Drag::Kind::kHand) drag_hand(state, to, move != Vec2::Zero(), wheel);
  if (!drag.let_go && drag.kind != Drag::Kind::kHand) drag_camera(state, move);
  if (io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2]) return;
  if (drag.kind == Drag::Kind::kHand && !drag.stays && !io.KeyShift)
    state.hands.release(*state.session, drag.hand);
  drag = {};
}

}  // namespace

void handle_mouse(ViewerState& state) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 pixel = mouse_place();
  const double wheel = static_cast<double>(io.MouseWheel);
  if (state.drag.kind != Drag::Kind::kNone && state.drag.tile >= state.tiles.size()) {  // its cloth is gone
    if (state.drag.kind == Drag::Kind::kHand && !state.drag.stays)
      state.hands.release(*state.session, state.drag.hand);
    state.drag = {};
  }
  // The view was let go and the cloth gripped between two pictures.
  if (state.drag.kind != Drag::Kind::kHand && ImGui::IsMouseClicked(0) && !io.MouseDown[1] &&
      !io.MouseDown[2])
    state.drag = {};
  if (state.drag.kind == Drag::Kind::kNone) {
    const std::size_t button = pressed_button();
    const bool told = button < kMouseButtons && state.buttons[button].presses > 0;
    const Vec2 place = told ? place_of(state.buttons[button].pressed_at) : pixel;
    const int tile = tile_at(state, place);
    if (io.WantCaptureMouse || tile < 0) return;
    if (button < kMouseButtons) press(state, button, static_cast<std::size_t>(tile), place, pixel);
    if (state.drag.kind == Drag::Kind::kNone && wheel != 0.0) {
      const ScreenTile& t = state.tiles[static_cast<std::size_t>(tile)];
      state.camera.zoom(wheel, place_in(t, pixel), aspect_of(t));
    }
    return;
  }
  if (state.drag.kind == Drag::Kind::kHand && state.buttons[kLeft].presses > 0) {
    click_again(state);
    return;
  }
  drag_on(state, pixel, wheel);
}

void handle_keys(ViewerState& state, const std::vector<KeyPress>& keys) {
  if (ImGui::GetIO().WantTextInput) return;
  for (const KeyPress& press : keys) act(state, action_of(press));
}

}  // namespace fuai
