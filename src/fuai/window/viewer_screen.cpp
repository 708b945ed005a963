// Opens the screen and paints on it.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer_screen.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "fuai/runtime/paced_thread.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

/// Height of the letters at scale 1 [pixel].
constexpr float kLetters = 15.0F;

PictureQuality quality_of(const std::string& renderer) {
  const auto has = [&](const char* name) { return renderer.find(name) != std::string::npos; };
  // Drivers that compute on the processor.
  if (has("llvmpipe") || has("softpipe") || has("SWR")) return {0, 8};
  return {};
}

}  // namespace

ViewerScreen::ViewerScreen(const ViewerOptions& options, ViewerState& state) {
  host_ = options.window ? make_window_host(options.width, options.height, "fuai")
                         : make_headless_host(options.width, options.height);
  renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  if (options.window) quality_ = quality_of(renderer_);  // else pictures for people, whatever they take
  const std::string missing = take_scale(state);
  if (!missing.empty() && options.say) options.say(missing);
  painter_ = std::make_unique<ClothPainter>();
}

std::string ViewerScreen::take_scale(ViewerState& state) {
  state.settings.scale = std::max(0.01F * static_cast<float>(state.settings.letters) * host_->scale(), 0.5F);
  std::string names;
  for (const ViewFabric& fabric : state.document.setup().fabrics)
    names += fabric.measured.name + fabric.measured.composition;
  std::string missing = load_fonts(std::round(kLetters * state.settings.scale), names);
  apply_theme(state.settings.dark, state.settings.scale);
  return missing;
}

void ViewerScreen::rescale(ViewerState& state) {
  ImGui_ImplOpenGL3_DestroyFontsTexture();  // made again with the next frame
  take_scale(state);
}

void ViewerScreen::resize() {
  target_.resize(std::max(host_->width(), 64), std::max(host_->height(), 64), quality_.samples);
}

void ViewerScreen::paint(const ViewerState& state) {
  const double start = 1e-3 * PacedThread::now_us();
  glBindFramebuffer(GL_FRAMEBUFFER, target_.screen());
  glDisable(GL_FRAMEBUFFER_SRGB);
  glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  for (std::size_t i = 0; i < state.tiles.size(); ++i) {
    const ScreenTile& tile = state.tiles[i];
    const GLuint buffer = target_.begin_tile(tile);
    painter_->paint(cloth_picture(state, i, quality_.ambient_directions), buffer, tile.width, tile.height);
    target_.end_tile(tile);
  }
  if (paint_times_.size() >= kMostPictureTimes) paint_times_.clear();
  paint_times_.push_back(1e-3 * PacedThread::now_us() - start);
  glBindFramebuffer(GL_FRAMEBUFFER, target_.screen());
  glDisable(GL_FRAMEBUFFER_SRGB);
  glViewport(0, 0, target_.width(), target_.height());
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Image ViewerScreen::read() const {
  Image image = target_.read();
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
  return image;
}

}  // namespace fuai
