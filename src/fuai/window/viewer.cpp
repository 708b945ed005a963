// The loop of the window: events, panels, pictures, files.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer.h"

#include <backends/imgui_impl_opengl3.h>
#include <epoxy/gl.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/device/gamepad_rumble.h"
#include "fuai/device/registry.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/picture/cloth_painter.h"
#include "fuai/runtime/paced_thread.h"
#include "fuai/window/kept_settings.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_files.h"
#include "fuai/window/viewer_host.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

/// Height of the letters at scale 1 [pixel].
constexpr float kLetters = 15.0F;
/// Without a cloth's thread a picture's time is stepped at a time [ticks].
constexpr int kTicksAPicture = 16;

/// How much light a driver can afford in every picture.
struct Quality {
  int samples = 4, ambient_directions = 32;
};

Quality quality_of(const std::string& renderer) {
  const auto has = [&](const char* name) { return renderer.find(name) != std::string::npos; };
  // Drivers that compute on the processor.
  if (has("llvmpipe") || has("softpipe") || has("SWR")) return {0, 8};
  return {};
}

double now_ms() { return 1e-3 * PacedThread::now_us(); }

double median(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// ImGui for as long as it lives.
class UiContext {
 public:
  UiContext() {
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;  // else it litters the working folder
    ImGui::GetIO().LogFilename = nullptr;
  }
  UiContext(const UiContext&) = delete;
  UiContext& operator=(const UiContext&) = delete;
  ~UiContext() { ImGui::DestroyContext(); }
};

/// All of it. Members are destroyed from the last to the first: the cloth's thread ends before the session.
class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options) : options_(options), state_(setup_of(options)) {
    state_.settings = options.settings;
    state_.fabric_names = bundled_fabric_ids();
    std::error_code code;  // a folder that is gone, or cannot be looked at, is not offered
    const std::string& folder = options.kept.folder;
    state_.browse_folder = std::filesystem::is_directory(folder, code) ? folder : data_folder();
    load_texture();
    begin_session(state_);
    open_device();
    if (options_.rumble) open_rumble();
    open_host();
    if (!options.record.empty()) files_->start_recording(state_, options.record);
    state_.session->play(true);
    start_thread();
  }

  ViewerResult run() {
    while (!host_->closing() && !state_.wishes.quit && !over()) frame();
    ViewerResult result;
    thread_.reset();
    end_device(result);
    // Once more, without a step: the snapshot of the last tick, with its energies.
    state_.session->play(false);
    state_.session->tick(wall_us_ = std::max(wall_us_, PacedThread::now_us()) + 1e6);
    if (!options_.screenshot.empty()) write_screenshot();
    files_->follow(state_, target_);
    result.seconds = static_cast<double>(state_.session->ticks()) * kViewStep;
    result.pictures = pictures_;
    result.state_hash = state_.session->state_hash();
    result.picture_ms = median(picture_times_);
    result.paint_ms = median(paint_times_);
    result.renderer = renderer_;
    keep_settings();
    return result;
  }

 private:
  void say(const std::string& line) const {
    if (options_.say) options_.say(line);
  }

  void load_texture() {
    if (options_.texture.empty()) return;
    const std::string told = lay_texture(state_, options_.texture, options_.texture_width);
    if (!told.empty()) say(told);
  }

  void keep_settings() const {
    if (options_.settings_file.empty()) return;
    KeptSettings keep = options_.kept;
    keep.settings = settings_to_keep(options_.kept.settings, options_.settings, state_.settings);
    if (state_.browse_folder != data_folder()) keep.folder = state_.browse_folder;
    try {
      write_kept_settings(options_.settings_file, keep);
    } catch (const Error& e) {
      say(e.what());  // a window that ends well ends well
    }
  }

  static ViewSetup setup_of(const ViewerOptions& options) {
    ViewSetup setup = make_view_setup(options.scene, options.fabrics, options.size);
    setup.scene_moves = options.scene_moves;
    return setup;
  }
  bool steps_itself() const { return options_.seconds > 0.0 || !options_.window; }
  bool over() const {
    return options_.seconds > 0.0 &&
           static_cast<double>(state_.session->ticks()) * kViewStep >= options_.seconds - 0.5 * kViewStep;
  }

  /// A device that is not there is told, and the mouse goes on.
  void open_device() {
    const std::string driver = options_.device.substr(0, options_.device.find(':'));
    if (driver.empty() || find_device_driver(driver).name == mouse_driver().name) return;
    state_.device.asked = options_.device;
    try {
      HandDevice opened = open_hand_device(options_.device);
      if (steps_itself() && !opened.computed) {
        throw Error(ErrorKind::kUsage,
                    "'" + options_.device + "' lives in real time, and --seconds is computed time", {},
                    "leave --seconds out, or take --device simulated");
      }
      device_ =
          std::make_unique<DeviceHand>(std::move(opened), *state_.session,
                                       steps_itself() ? DeviceHand::Time::kVirtual : DeviceHand::Time::kReal);
      state_.device.model = device_->info().model;
      state_.device.gives_force = device_->info().peak_force > 0.0;
    } catch (const Error& e) {
      if (e.kind() != ErrorKind::kNoDevice) throw;
      tell(e.problem() + (e.cure().empty() ? "" : " (" + e.cure() + ")"));
    }
  }
  void open_rumble() {
    try {
      rumble_ = std::make_unique<GamepadRumble>();
    } catch (const Error& e) {
      tell(e.problem() + " (" + e.cure() + ")");
    }
  }
  /// As strong as the arrows are long: the force of the first cloth on the hand that gripped or moved last.
  void rumble() {
    if (!rumble_) return;
    const bool felt = state_.playing && !state_.forces.empty() && state_.forces.back().hand >= 0;
    if (rumble_->set(felt ? force_share(state_.forces.back().forces.front()) : 0.0)) return;
    rumble_.reset();
    tell("--rumble", TextId::kDeviceAway);
  }
  /// To the window in its language, and in English to whoever started it.
  void tell(const std::string& what, std::optional<TextId> more = {}) {
    const auto line = [&](Language language) {
      return what + (more ? std::string(": ") + ui_text(*more, language) : "") + "; " +
             ui_text(TextId::kDeviceMouseGoesOn, language);
    };
    state_.say(line(state_.settings.language), true);
    if (options_.say) options_.say(line(Language::kEnglish));
  }
  void follow_device() {
    if (!device_) return;
    const DeviceView before = std::exchange(state_.device.view, device_->look());
    const DeviceView& now = state_.device.view;
    if (now.away && !before.away) tell(state_.device.model, TextId::kDeviceAway);
    if (!now.away && before.away) state_.say(state_.device.model + ": " + state_.text(TextId::kDeviceBack));
    if (now.faulted && !before.faulted) tell(state_.device.model, TextId::kDeviceFault);
    device_force_ = std::max(device_force_, now.force);
  }
  void end_device(ViewerResult& result) {
    if (!device_) return;
    follow_device();
    const std::vector<std::string> refused = device_->end();
    if (options_.say)
      for (const std::string& line : refused) options_.say(line);
    result.device = state_.device.model;
    result.overruns = state_.device.view.overruns;
    result.device_force = device_force_;
  }

  void open_host() {
    host_ = options_.window ? make_window_host(options_.width, options_.height, "fuai")
                            : make_headless_host(options_.width, options_.height);
    renderer_ = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    quality_ = quality_of(renderer_);
    if (!options_.window) quality_ = {};  // pictures for people, whatever they take
    state_.settings.scale = std::max(host_->scale() * options_.settings.scale, 0.5F);
    std::string names;
    for (const ViewFabric& fabric : state_.document.setup().fabrics)
      names += fabric.measured.name + fabric.measured.composition;
    const std::string missing = load_fonts(std::round(kLetters * state_.settings.scale), names);
    if (!missing.empty()) say(missing);
    apply_theme(state_.settings.dark, state_.settings.scale);
    painter_ = std::make_unique<ClothPainter>();
    files_ = std::make_unique<ViewerFiles>(options_.folder, options_.version);
  }

  void start_thread() {
    if (device_) device_->begin(state_.cloths->scene(0).view);
    if (device_ || steps_itself()) return;
    thread_ = std::make_unique<PacedThread>(
        [session = state_.session.get()] { return session->tick(PacedThread::now_us()); }, kViewStep);
  }

  void aim() {
    if (options_.zoom > 1.0) look_at_cloth(state_);
  }

  void step_cloths() {
    follow_device();
    if (device_ && !steps_itself()) {
      device_->set_speed(state_.settings.speed);
      state_.real_time_factor = device_->real_time_factor();
      return;
    }
    if (thread_) {
      thread_->set_speed(state_.settings.speed);
      state_.real_time_factor = thread_->real_time_factor();
      return;
    }
    for (int i = 0; i < kTicksAPicture && !over(); ++i) {
      wall_us_ += 1e6 * kViewStep;
      if (device_)
        device_->tick(wall_us_);
      else
        state_.session->tick(wall_us_);
    }
  }

  void panels() {
    draw_menu(state_);
    draw_fabric_panel(state_);
    draw_plots_panel(state_);
    draw_time_panel(state_);
    draw_help(state_);
    draw_browser(state_);
  }

  void frame() {
    const double start = now_ms();
    host_->begin_frame();
    ImGui::NewFrame();
    state_.clock = host_->clock();
    target_.resize(std::max(host_->width(), 64), std::max(host_->height(), 64), quality_.samples);
    step_cloths();
    if (follow_document(state_)) {
      files_->setup_changed(state_);
      if (state_.built.scene != framed_scene_) {
        frame_next_ = true;
        if (device_) device_->begin(state_.cloths->scene(0).view);
      }
    }
    take_snapshot(state_);
    rumble();
    state_.tiles = make_tiles(lay_out(state_).view, state_.meshes.size());
    if (frame_next_) {
      frame_view(state_);
      aim();
      state_.camera.approach(options_.zoom);
      framed_scene_ = state_.built.scene;
      frame_next_ = false;
    }
    handle_keys(state_, host_->take_keys());
    state_.left_presses = host_->take_left_presses();
    panels();
    handle_mouse(state_);
    draw_overlay_2d(state_);
    ImGui::Render();
    // Without a window nobody looks before the end.
    if (options_.window) paint();
    host_->show(target_);
    serve_wishes();
    files_->follow(state_, target_);
    note_times(start);
  }

  void paint() {
    const double start = now_ms();
    glBindFramebuffer(GL_FRAMEBUFFER, target_.screen());
    glDisable(GL_FRAMEBUFFER_SRGB);
    glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT);
    for (std::size_t i = 0; i < state_.tiles.size(); ++i) {
      const ScreenTile& tile = state_.tiles[i];
      const GLuint buffer = target_.begin_tile(tile);
      painter_->paint(cloth_picture(state_, i, quality_.ambient_directions), buffer, tile.width, tile.height);
      target_.end_tile(tile);
    }
    paint_times_.push_back(now_ms() - start);
    glBindFramebuffer(GL_FRAMEBUFFER, target_.screen());
    glDisable(GL_FRAMEBUFFER_SRGB);
    glViewport(0, 0, target_.width(), target_.height());
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  }

  void serve_wishes() {
    ViewWishes& wishes = state_.wishes;
    if (wishes.new_theme) apply_theme(state_.settings.dark, state_.settings.scale);
    if (wishes.full_screen) host_->toggle_full_screen();
    if (wishes.open) open_path(state_, *wishes.open);
    for (const std::string& path : host_->take_dropped()) open_path(state_, path);
    files_->serve(state_, target_, *painter_);
    const bool quit = wishes.quit;
    wishes = {};
    wishes.quit = quit;
    while (!state_.messages.empty() && state_.messages.front().until < state_.clock)
      state_.messages.pop_front();
  }

  void write_screenshot() {
    // Once more, with what the last ticks made; of the whole window, panels included.
    take_snapshot(state_);
    if (!options_.window) aim();  // nobody could follow the cloth
    host_->begin_frame();
    ImGui::NewFrame();
    state_.tiles = make_tiles(lay_out(state_).view, state_.meshes.size());
    panels();
    draw_overlay_2d(state_);
    ImGui::Render();
    paint();
    Image image = target_.read();
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
    write_atomically(options_.screenshot, encode_png(image));
  }

  void note_times(double start) {
    const double now = now_ms();
    if (last_picture_ > 0.0) {
      picture_times_.push_back(now - last_picture_);
      state_.picture_ms = 0.9 * state_.picture_ms + 0.1 * (now - last_picture_);
    } else {
      state_.picture_ms = now - start;
    }
    last_picture_ = now;
    ++pictures_;
    constexpr std::size_t kMostTimes = 20000;
    if (picture_times_.size() > kMostTimes) picture_times_.clear();
    if (paint_times_.size() > kMostTimes) paint_times_.clear();
  }

  ViewerOptions options_;
  ViewerState state_;
  UiContext ui_;
  std::unique_ptr<ViewerHost> host_;
  std::string renderer_, framed_scene_;
  Quality quality_;
  std::unique_ptr<ClothPainter> painter_;
  ScreenTarget target_;
  std::unique_ptr<ViewerFiles> files_;
  bool frame_next_ = true;
  double wall_us_ = 0.0;  // of the ticks that are done here
  double last_picture_ = 0.0;
  std::int64_t pictures_ = 0;
  std::vector<double> picture_times_, paint_times_;
  double device_force_ = 0.0;
  std::unique_ptr<GamepadRumble> rumble_;
  std::unique_ptr<DeviceHand> device_;
  std::unique_ptr<PacedThread> thread_;
};

}  // namespace

ViewerResult run_viewer(const ViewerOptions& options) {
  if (!options.screenshot.empty()) check_can_write(options.screenshot);
  return Viewer(options).run();
}

}  // namespace fuai
