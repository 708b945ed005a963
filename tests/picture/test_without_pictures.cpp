// A library without drawing code says so.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <functional>

#include "fuai/core/error.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/picture/plot.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("every way to a picture reports that pictures were left out, and the cure") {
    const std::function<void()> calls[] = {
        [] { make_offscreen_renderer(); }, [] { plot_png(Plot{}, 100, 100); },
        [] { plot_svg(PlotGrid{}, 100, 100); }, [] { encode_png(Image{}); }, [] { decode_png("", ""); }};
    for (const auto& call : calls) {
      try {
        call();
        FAIL("nothing was thrown");
      } catch (const Error& error) {
        CHECK(error.kind() == ErrorKind::kNoDevice);
        CHECK(error.cure().find("libepoxy-dev") != std::string::npos);
      }
    }
  }
}
