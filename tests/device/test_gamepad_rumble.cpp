// Rumble of a gamepad: a pipe in place of its node, and the kernel's calls written down.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/gamepad_rumble.h"

#include <doctest/doctest.h>
#include <fcntl.h>
#include <linux/input.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include "fuai/core/error.h"

using namespace fuai;

namespace {

struct FakeKernel {
  bool rumbles = true, gone = false;
  int uploads = 0;
  ff_effect last{};
};
FakeKernel kernel;

int fake_call(int /*descriptor*/, unsigned long request, void* argument) {
  if (kernel.gone) {
    errno = ENODEV;
    return -1;
  }
  if (request == EVIOCSFF) {
    auto& effect = *static_cast<ff_effect*>(argument);
    if (effect.id == -1) effect.id = 3;
    kernel.last = effect;
    ++kernel.uploads;
    return 0;
  }
  if (kernel.rumbles) static_cast<std::uint8_t*>(argument)[FF_RUMBLE / 8] |= 1 << (FF_RUMBLE % 8);
  return 0;
}

struct Node {
  Node()
      : path((std::filesystem::temp_directory_path() / ("fuai-rumble" + std::to_string(::getpid())))
                 .string()) {
    REQUIRE(::mkfifo(path.c_str(), 0600) == 0);
    pipe = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    kernel = {};
  }
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;
  ~Node() {
    ::close(pipe);
    ::unlink(path.c_str());
  }
  /// What was played since the last call: the last value, -1: nothing.
  int played() const {
    int value = -1;
    input_event event{};
    while (::read(pipe, &event, sizeof event) == static_cast<ssize_t>(sizeof event)) {
      CHECK(event.type == EV_FF);
      CHECK(event.code == 3);
      value = event.value;
    }
    return value;
  }
  std::string path;
  int pipe = -1;
};

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("rumble follows the strength, one effect for all, and stops at zero and at the end") {
    const Node node;
    {
      GamepadRumble rumble(node.path, fake_call);
      CHECK(rumble.set(0.0));  // nothing to stop
      CHECK(kernel.uploads == 0);
      CHECK(rumble.set(0.5));
      CHECK(kernel.last.type == FF_RUMBLE);
      CHECK(kernel.last.u.rumble.strong_magnitude == 32768);
      CHECK(kernel.last.replay.length == kRumbleLasts_ms);
      CHECK(node.played() == 1);
      CHECK(rumble.set(7.0));
      CHECK(kernel.last.id == 3);
      CHECK(kernel.last.u.rumble.weak_magnitude == 0xffff);
      CHECK(node.played() == 1);
      CHECK(rumble.set(std::nan("")));
      CHECK(node.played() == 0);
      CHECK(rumble.set(1.0));
      CHECK(kernel.uploads == 3);
      CHECK(node.played() == 1);
    }
    CHECK(node.played() == 0);
  }

  TEST_CASE("a gamepad that does not rumble is refused, one that is gone is told once and for all") {
    const Node node;
    kernel.rumbles = false;
    CHECK_THROWS_AS(GamepadRumble(node.path, fake_call), Error);
    kernel.rumbles = true;
    GamepadRumble rumble(node.path, fake_call);
    CHECK(rumble.set(1.0));
    kernel.gone = true;
    CHECK_FALSE(rumble.set(1.0));
    kernel.gone = false;
    CHECK_FALSE(rumble.set(1.0));
    CHECK_THROWS_AS(GamepadRumble("/nosuch/event0", fake_call), Error);
  }
}
