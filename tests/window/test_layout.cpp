// Where panels and cloths lie, for windows of every size.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <vector>

#include "fuai/window/viewer_host.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace {

using namespace fuai;

/// ImGui with a window of a size, and a frame that has begun.
struct Frame {
  Frame(float width, float height) {
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = {width, height};
    unsigned char* pixels = nullptr;
    int columns = 0, rows = 0;
    io.Fonts->GetTexDataAsAlpha8(&pixels, &columns, &rows);
    ImGui::NewFrame();
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;
  ~Frame() {
    ImGui::EndFrame();
    ImGui::DestroyContext();
  }
};

bool apart(const ViewBox& a, const ViewBox& b) {
  return a.left + a.width <= b.left || b.left + b.width <= a.left || a.top + a.height <= b.top ||
         b.top + b.height <= a.top;
}

void check_tiles(const ViewBox& view) {
  for (std::size_t count = 1; count <= kMostViewFabrics; ++count) {
    std::vector<ViewBox> boxes;
    for (const ScreenTile& tile : make_tiles(view, count))
      boxes.push_back({static_cast<float>(tile.left), static_cast<float>(tile.top),
                       static_cast<float>(tile.width), static_cast<float>(tile.height)});
    REQUIRE(boxes.size() == count);
    for (std::size_t i = 0; i < count; ++i) {
      CHECK(boxes[i].left >= view.left - 1.0F);  // a tile has whole pixels
      CHECK(boxes[i].left + boxes[i].width <= view.left + view.width + 1.0F);
      CHECK(boxes[i].top + boxes[i].height <= view.top + view.height + 1.0F);
      for (std::size_t j = 0; j < i; ++j) CHECK(apart(boxes[i], boxes[j]));
    }
  }
}

}  // namespace

TEST_SUITE("property") {
  TEST_CASE("Panels and cloths never overlap, and the cloths have the larger part") {
    ViewerState state(make_view_setup("hanging_sheet", {"wool-tropical"}, {}));
    constexpr std::array<std::array<float, 2>, 7> kSizes{
        {{200, 150}, {320, 320}, {640, 400}, {800, 600}, {1280, 720}, {1920, 1080}, {3840, 2160}}};
    for (const auto& [width, height] : kSizes) {
      const Frame frame(width, height);
      for (const int shown : {0, 1, 2, 3}) {
        CAPTURE(width);
        CAPTURE(shown);
        state.settings.fabric_panel = (shown & 1) != 0;
        state.settings.plots = (shown & 2) != 0;
        const ViewLayout layout = lay_out(state);
        const std::array<ViewBox, 4> boxes{layout.fabric, layout.plots, layout.time, layout.view};
        for (std::size_t i = 0; i < boxes.size(); ++i) {
          CHECK(boxes[i].left >= 0.0F);
          CHECK(boxes[i].left + boxes[i].width <= width);
          CHECK(boxes[i].top + boxes[i].height <= height);
          for (std::size_t j = 0; j < i; ++j) CHECK(apart(boxes[i], boxes[j]));
        }
        // Two side panels of at most 0.3 leave 0.4 of the width; the bars take 100 pixels of the height.
        CHECK(layout.view.width >= 0.39F * width);
        CHECK(layout.view.height >= height - 100.0F);
        check_tiles(layout.view);
      }
    }
  }

  TEST_CASE("Lines of the hint hide a fifth of the view at most") {
    const std::array heights{20.0F, 40.0F, 60.0F};
    const auto fit = [&](float height) { return lines_that_fit({0.0F, 0.0F, 400.0F, height}, heights); };
    CHECK(fit(60.0F) == 0);
    CHECK(fit(99.0F) == 0);
    CHECK(fit(101.0F) == 1);
    CHECK(fit(299.0F) == 2);
    CHECK(fit(301.0F) == 3);
    CHECK(lines_that_fit({0.0F, 0.0F, 400.0F, 300.0F}, {}) == 0);
  }

  TEST_CASE("A fine screen whose system tells no scale has larger letters") {
    CHECK(fitting_scale(1.0F, 1920, 508) == 1.0F);    // 96 dpi, as Xvfb says
    CHECK(fitting_scale(1.0F, 2560, 597) == 1.0F);    // 27 inches, 109 dpi
    CHECK(fitting_scale(1.0F, 3840, 941) == 1.0F);    // 43 inches, 104 dpi
    CHECK(fitting_scale(1.0F, 3840, 597) == 1.75F);   // 27 inches, 163 dpi
    CHECK(fitting_scale(1.0F, 3840, 294) == 3.0F);    // 13 inches, 332 dpi
    CHECK(fitting_scale(1.25F, 3840, 597) == 1.25F);  // what the system says counts
    CHECK(fitting_scale(1.0F, 3840, 160) == 1.0F);    // an aspect ratio
    CHECK(fitting_scale(1.0F, 3840, 0) == 1.0F);
  }

  TEST_CASE("A small window leaves out what could not be read") {
    ViewerState state(make_view_setup("hanging_sheet", {"wool-tropical"}, {}));
    const auto widths = [&](float width, float height) {
      const Frame frame(width, height);
      const ViewLayout layout = lay_out(state);
      return std::array{layout.fabric.width > 0.0F, layout.plots.width > 0.0F};
    };
    CHECK(widths(1280, 720) == std::array{true, true});
    CHECK(widths(1280, 240) == std::array{true, false});
    CHECK(widths(500, 720) == std::array{true, false});
    CHECK(widths(300, 720) == std::array{false, false});
  }
}
