// Fuzzes the readers of 3D mice and gamepads: pieces make no difference, and hands stay in their box.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "fuai/device/input_events_rt.h"
#include "fuai/device/rate_control_rt.h"

namespace {

void check(const fuai::InputState& whole, const fuai::InputState& pieces) {
  if (whole.deflection != pieces.deflection || whole.buttons != pieces.buttons || whole.pinch != pieces.pinch)
    std::abort();
  if (!(whole.pinch >= 0.0 && whole.pinch <= 1.0)) std::abort();
  fuai::RateControl hand;
  for (int i = 0; i < 200; ++i) hand.update(whole.deflection, 0.1 * i);
  if (!(hand.position().cwiseAbs().maxCoeff() <= fuai::RateControl::kReach)) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t step = 1 + data[0] % 64;  // the first byte says how large the pieces are
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  fuai::SpacenavReader first, second;
  fuai::JoystickReader third, fourth;
  const bool good = first.take(bytes);
  third.take(bytes);
  bool still = true;
  for (std::size_t at = 0; at < bytes.size(); at += step) {
    const auto piece = bytes.subspan(at, std::min(step, bytes.size() - at));
    still = still && second.take(piece);
    fourth.take(piece);
  }
  if (good != still) std::abort();
  check(first.state(), second.state());
  check(third.state(), fourth.state());
  return 0;
}
