// Stands in for the drawing code when the library is built without Cairo, EGL and epoxy.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/core/error.h"
#include "fuai/picture/image.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/picture/plot.h"
#include "fuai/picture/sheet.h"

namespace fuai {
namespace {

[[noreturn]] void fail() {
  throw Error(
      ErrorKind::kNoDevice, "this program was built without pictures", {},
      "install the Debian packages libepoxy-dev libegl-dev libcairo2-dev libstb-dev and build it again "
      "with FUAI_PICTURES on");
}

}  // namespace

struct OffscreenRenderer::Parts {};
OffscreenRenderer::OffscreenRenderer(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
OffscreenRenderer::OffscreenRenderer(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer& OffscreenRenderer::operator=(OffscreenRenderer&&) noexcept = default;
OffscreenRenderer::~OffscreenRenderer() = default;
OffscreenRenderer make_offscreen_renderer() { fail(); }
Image OffscreenRenderer::render(const ClothPicture&, int, int) { fail(); }

std::string encode_png(const Image&) { fail(); }
Image decode_png(std::string_view, const std::string&) { fail(); }
std::string plot_png(const PlotGrid&, int, int, double) { fail(); }
std::string plot_png(const Plot&, int, int, double) { fail(); }
std::string plot_svg(const PlotGrid&, int, int) { fail(); }
std::string plot_svg(const Plot&, int, int) { fail(); }

std::string sheet_png(const Sheet&, double) { fail(); }
std::string sheet_svg(const Sheet&) { fail(); }

}  // namespace fuai
