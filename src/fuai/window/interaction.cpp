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
  if (ImGui::IsMouseDoubleClicked(0) || state.left_presses > 1) {
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

void drag_camera(ViewerState& state) {
  const ImVec2 delta = ImGui::GetIO().MouseDelta;
  const Vec2 move(static_cast<double>(delta.x), static_cast<double>(delta.y));
  const double height = state.tiles[state.drag.tile].height;
  if (state.drag.kind == Drag::Kind::kOrbit) state.camera.orbit(move, height);
  if (state.drag.kind == Drag::Kind::kPan) state.camera.pan(move, height);
}

void press(ViewerState& state, std::size_t tile, const Vec2& pixel) {
  const bool shift = ImGui::GetIO().KeyShift;
  if (ImGui::IsMouseClicked(0)) {
    // Between two slow pictures a quick hand goes far: what it pressed counts, then where it went.
    const bool went =
        state.left_presses > 0 && state.press_place != pixel && inside(state.tiles[tile], state.press_place);
    press_left(state, tile, went ? state.press_place : pixel, shift);
    if (went && state.drag.kind == Drag::Kind::kHand) drag_hand(state, pixel, true, 0.0);
  }
  if (ImGui::IsMouseClicked(2) || (ImGui::IsMouseClicked(1) && shift))
    state.drag = {Drag::Kind::kPan, -1, tile, false};
  else if (ImGui::IsMouseClicked(1))
    state.drag = {Drag::Kind::kOrbit, -1, tile, false};
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
    const int tile = tile_at(state, pixel);
    if (io.WantCaptureMouse || tile < 0) return;
    press(state, static_cast<std::size_t>(tile), pixel);
    if (state.drag.kind == Drag::Kind::kNone && wheel != 0.0) {
      const ScreenTile& t = state.tiles[static_cast<std::size_t>(tile)];
      state.camera.zoom(wheel, place_in(t, pixel), aspect_of(t));
    }
    return;
  }
  if (state.drag.kind == Drag::Kind::kHand && state.left_presses > 0) {
    click_again(state);
    return;
  }
  if (state.drag.kind == Drag::Kind::kHand)
    drag_hand(state, pixel, io.MouseDelta.x != 0.0F || io.MouseDelta.y != 0.0F, wheel);
  else
    drag_camera(state);
  if (!io.MouseDown[0] && !io.MouseDown[1] && !io.MouseDown[2]) {
    if (state.drag.kind == Drag::Kind::kHand && !state.drag.stays && !io.KeyShift)
      state.hands.release(*state.session, state.drag.hand);
    state.drag = {};
  }
}

void handle_keys(ViewerState& state, const std::vector<KeyPress>& keys) {
  if (ImGui::GetIO().WantTextInput) return;
  for (const KeyPress& press : keys) act(state, action_of(press));
}

}  // namespace fuai
