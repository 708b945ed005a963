// The loop of the window: events, panels, pictures, files.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer.h"

#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/runtime/paced_thread.h"
#include "fuai/window/kept_settings.h"
#include "fuai/window/paint_pace.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_device.h"
#include "fuai/window/viewer_files.h"
#include "fuai/window/viewer_replay.h"
#include "fuai/window/viewer_screen.h"
#include "fuai/window/viewer_state.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

/// Without a cloth's thread a picture's time is stepped at a time [ticks].
constexpr int kTicksAPicture = 16;
/// At rest the window looks so often whether the cloths have something new, or somebody ends it [s].
constexpr double kLook = 0.01;
/// The cursor in a text blinks, and a folder that is looked at may change [s].
constexpr double kBlink = 0.5;

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
  explicit Viewer(const ViewerOptions& options)
      : options_(options), state_(setup_of(options)), device_(state_, options.say) {
    state_.settings = options.settings;
    state_.fabric_names = bundled_fabric_ids();
    std::error_code code;  // a folder that is gone, or cannot be looked at, is not offered
    const std::string& folder = options.kept.folder;
    state_.browse_folder = std::filesystem::is_directory(folder, code) ? folder : data_folder();
    state_.felt = options.felt;
    if (options.fabrics.size() > 1) state_.steps.did(FirstStep::kCompare);
    load_texture();
    begin_session(state_);
    device_.open(options_, steps_itself());
    screen_ = std::make_unique<ViewerScreen>(options_, state_);
    pace_ = PaintPace(screen_->host().rate());
    files_ = std::make_unique<ViewerFiles>(options_.folder, options_.version);
    if (!options.record.empty()) files_->start_recording(state_, options.record);
    if (!options.replay.empty()) open_replay(state_, options.replay);
    state_.session->play(true);
    start_thread();
  }

  ViewerResult run() {
    while (!ended()) {
      rest();
      frame();
    }
    ViewerResult result;
    thread_.reset();
    device_.end(result);
    // Once more, without a step: the snapshot of the last tick, with its energies.
    state_.session->play(false);
    state_.session->tick(wall_us_ = std::max(wall_us_, PacedThread::now_us()) + 1e6);
    if (!options_.screenshot.empty()) write_screenshot();
    result.forces = state_.shown_forces;
    files_->follow(state_, screen_->target());
    result.messages.assign(state_.said.begin(), state_.said.end());
    result.seconds = static_cast<double>(state_.session->ticks()) * kViewStep;
    result.pictures = pictures_;
    result.paused_pictures = paused_pictures_;
    result.state_hash = state_.session->state_hash();
    result.picture_ms = median(picture_times_);
    result.paint_ms = median(screen_->paint_times());
    if (state_.replay) {
      result.replay_hashes = state_.replay->hashes;
      result.replay_matches = state_.replay->first_difference < 0;
    }
    result.renderer = screen_->renderer();
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
    if (options_.stop != nullptr && options_.stop->load()) return true;
    if (steps_itself() && state_.replay && state_.replay->over) return true;
    return options_.seconds > 0.0 &&
           static_cast<double>(state_.session->ticks()) * kViewStep >= options_.seconds - 0.5 * kViewStep;
  }

  bool ended() const {
    const bool quits = state_.wishes.quit && !state_.wishes.any();  // what was asked for before is done
    return screen_->host().closing() || quits || over();
  }

  /// Whether the picture changes without anybody doing anything.
  bool goes_on() const {
    return state_.playing || device_.ticks() || state_.rumbles || state_.filming || state_.wishes.any();
  }

  /// Waits until there is something to paint, and the screen ready to show it.
  void rest() {
    if (!options_.window || steps_itself()) return;
    ViewerHost& host = screen_->host();
    while (!ended()) {
      const double now = host.clock();
      if (host.take_happened() || goes_on() || take_snapshot(state_)) pace_.wake();
      const bool blinks = ImGui::GetIO().WantTextInput || state_.browsing;
      if ((blinks && now > state_.clock + kBlink) ||
          (!state_.messages.empty() && state_.messages.front().until < now))
        pace_.wake(2);  // what is over is taken away behind a picture
      const double wait = pace_.due_in(now);
      if (wait <= 0.0) return;
      if (pace_.at_rest()) last_picture_ = 0.0;  // the next one does not come late
      host.wait(std::min(wait, kLook));
    }
  }

  void start_thread() {
    device_.begin();
    if (device_.ticks() || steps_itself()) return;
    thread_ = std::make_unique<PacedThread>(
        [session = state_.session.get()] { return session->tick(PacedThread::now_us()); }, kViewStep);
  }

  void aim() {
    if (options_.zoom > 1.0) look_at_cloth(state_);
  }

  void step_cloths() {
    device_.follow();
    DeviceHand* hand = device_.hand();
    if (hand != nullptr && !steps_itself()) {
      hand->set_speed(state_.settings.speed);
      state_.real_time_factor = hand->real_time_factor();
      return;
    }
    if (thread_) {
      thread_->set_speed(state_.settings.speed);
      state_.real_time_factor = thread_->real_time_factor();
      return;
    }
    for (int i = 0; i < kTicksAPicture && !over(); ++i) {
      wall_us_ += 1e6 * kViewStep;
      if (hand != nullptr)
        hand->tick(wall_us_);
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
    ViewerHost& host = screen_->host();
    host.begin_frame();
    ImGui::NewFrame();
    state_.clock = host.clock();
    const bool seen = steps_itself() || host.visible();
    pace_.hide(!seen);
    pace_.begin(state_.clock);
    screen_->resize();
    step_cloths();
    const bool replaced = follow_replay(state_);
    if (follow_document(state_) || replaced) {
      files_->setup_changed(state_);
      if (state_.built.scene != framed_scene_) {
        frame_next_ = true;
        device_.begin();
      }
    }
    take_snapshot(state_);
    device_.follow_force();
    state_.tiles = make_tiles(lay_out(state_).view, state_.meshes.size());
    if (frame_next_) {
      frame_view(state_);
      aim();
      state_.camera.approach(options_.zoom);
      framed_scene_ = state_.built.scene;
      frame_next_ = false;
    }
    handle_keys(state_, host.take_keys());
    state_.buttons = host.take_buttons();
    panels();
    handle_mouse(state_);
    draw_overlay_2d(state_);
    ImGui::Render();
    // Without a window nobody looks before the end.
    const bool paints = options_.window && (seen || state_.filming);
    if (paints) screen_->paint(state_);
    if (seen) host.show(screen_->target());
    serve_wishes();
    files_->follow(state_, screen_->target());
    if (paints || !options_.window) note_times(start);
  }

  void serve_wishes() {
    ViewWishes& wishes = state_.wishes;
    if (wishes.new_theme) apply_theme(state_.settings.dark, state_.settings.scale);
    if (wishes.new_scale) screen_->rescale(state_);
    if (wishes.full_screen > 0) screen_->host().toggle_full_screen();
    if (wishes.open) open_path(state_, *wishes.open);
    for (const std::string& path : screen_->host().take_dropped()) open_path(state_, path);
    files_->serve(state_, screen_->target(), screen_->painter());
    wishes.one_done();
    while (!state_.messages.empty() && state_.messages.front().until < state_.clock)
      state_.messages.pop_front();
  }

  void write_screenshot() {
    // Once more, with what the last ticks made; of the whole window, panels included.
    take_snapshot(state_);
    if (!options_.window) aim();  // nobody could follow the cloth
    screen_->host().begin_frame();
    ImGui::NewFrame();
    state_.tiles = make_tiles(lay_out(state_).view, state_.meshes.size());
    panels();
    draw_overlay_2d(state_);
    ImGui::Render();
    screen_->paint(state_);
    write_atomically(options_.screenshot, encode_png(screen_->read()));
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
    if (!state_.playing) ++paused_pictures_;
    if (picture_times_.size() > kMostPictureTimes) picture_times_.clear();
  }

  ViewerOptions options_;
  ViewerState state_;
  UiContext ui_;
  std::unique_ptr<ViewerScreen> screen_;
  std::unique_ptr<ViewerFiles> files_;
  std::string framed_scene_;
  bool frame_next_ = true;
  PaintPace pace_{kUsualRate};
  double wall_us_ = 0.0;  // of the ticks that are done here
  double last_picture_ = 0.0;
  std::int64_t pictures_ = 0, paused_pictures_ = 0;
  std::vector<double> picture_times_;
  ViewerDevice device_;
  std::unique_ptr<PacedThread> thread_;
};

}  // namespace

ViewerResult run_viewer(const ViewerOptions& options) {
  if (!options.screenshot.empty()) check_can_write(options.screenshot);
  return Viewer(options).run();
}

}  // namespace fuai
