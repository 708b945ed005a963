// Without a graphics driver the renderer says which packages are missing; plots need none.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "fuai/core/error.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/picture/plot.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("the renderer reports the missing driver and its packages, every time") {
    for (int attempt = 0; attempt < 2; ++attempt) {
      try {
        make_offscreen_renderer();
        FAIL("a driver was found");
      } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::kNoDevice);
        CHECK(error.problem().find("EGL") != std::string::npos);
        CHECK(error.cure().find("libegl-mesa0") != std::string::npos);
        CHECK(error.cure().find("libgl1-mesa-dri") != std::string::npos);
      }
    }
  }

  TEST_CASE("a plot is drawn without a driver") { CHECK(plot_png(Plot{}, 200, 150).size() > 100); }
}
