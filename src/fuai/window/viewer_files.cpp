// Writes what the window is asked for.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/mesh_gltf.h"
#include "fuai/io/mesh_obj.h"
#include "fuai/io/text_file.h"
#include "fuai/picture/overlay.h"
#include "fuai/runtime/frame_pipe.h"
#include "fuai/window/scaled_fabric.h"
#include "fuai/window/viewer_work.h"

namespace fuai {
namespace {

constexpr int kFilmRate = 30;  // pictures a simulated second
constexpr int kFilmDirections = 64;

/// Runs what may fail; tells it. @return whether it did not
template <class Work>
bool try_files(ViewerState& state, const Work& work) {
  try {
    work();
    return true;
  } catch (const Error& e) {
    state.say(state.text(e), true);
    return false;
  }
}

/// Files are of the fabric whose page is shown.
std::size_t shown_fabric(const ViewerState& state) {
  return std::min(state.page, state.built.fabrics.size() - 1);
}

std::vector<GraspReading> readings_of(const ClothView& view) {
  std::vector<GraspReading> readings(view.hands.begin(), view.hands.end());
  readings.insert(readings.end(), view.scene_hands.begin(), view.scene_hands.end());
  return readings;
}

}  // namespace

/// A film of the part of the window where the cloths are.
class ViewerFiles::Video {
 public:
  /// @param path of the film; without ffmpeg numbered pictures go to a folder of that name
  Video(const std::string& path, const ScreenTile& part) : part_(part) {
    if (FramePipe::available()) {
      path_ = path + ".mp4";
      pipe_ = std::make_unique<FramePipe>(path_, part.width, part.height, kFilmRate);
    } else {
      path_ = path;
      std::error_code code;
      std::filesystem::create_directories(path_, code);
      if (code)
        throw Error(ErrorKind::kBadInput, "cannot make the folder: " + code.message(), {path_, 0, 0, ""},
                    "start with another --out");
    }
  }
  const std::string& path() const { return path_; }
  bool is_film() const { return pipe_ != nullptr; }

  /// A picture whenever its time has come. @throws Error when it cannot go on
  void follow(double time, const ScreenTarget& target) {
    if (next_ < 0.0 || time < next_ - 1.0) next_ = time;  // the beginning, or a way back in time
    if (time < next_) return;
    next_ += 1.0 / kFilmRate;
    if (time > next_) next_ = time;
    if (part_.left + part_.width > target.width() || part_.top + part_.height > target.height())
      throw Error(ErrorKind::kBadInput, "the window became smaller than the video, which ends here",
                  {path_, 0, 0, ""}, "film again");
    Image image = target.read(part_);
    for (std::size_t i = 3; i < image.pixels.size(); i += 4) image.pixels[i] = 255;
    if (pipe_) {
      if (!pipe_->write(image.pixels))
        throw Error(ErrorKind::kBadInput, "ffmpeg has ended before the video", {path_, 0, 0, ""},
                    "see that the folder can be written and has room");
      return;
    }
    char name[32];
    std::snprintf(name, sizeof name, "/%06d.png", ++count_);
    write_atomically(path_ + name, encode_png(image));
  }

 private:
  ScreenTile part_;
  std::string path_;
  std::unique_ptr<FramePipe> pipe_;
  double next_ = -1.0;
  int count_ = 0;
};

ViewerFiles::ViewerFiles(std::string folder, std::string version)
    : folder_(std::move(folder)), version_(std::move(version)) {}
ViewerFiles::~ViewerFiles() = default;

/// A name that no file has yet: stem-001.png.
std::string ViewerFiles::free_name(const std::string& stem, const std::string& ending) const {
  for (int i = 1;; ++i) {
    char number[16];
    std::snprintf(number, sizeof number, "-%03d", i);
    const std::string path = (std::filesystem::path(folder_) / (stem + number)).string();
    std::error_code code;  // what cannot be looked at is told when it is written
    if (!std::filesystem::exists(path + ending, code) && !std::filesystem::exists(path, code))
      return path + ending;
  }
}

Image ViewerFiles::cloths_image(const ViewerState& state, ScreenTarget& target, ClothPainter& painter,
                                bool caption, bool transparent) const {
  std::vector<Image> images;
  for (std::size_t i = 0; i < state.tiles.size(); ++i) {
    const ScreenTile& tile = state.tiles[i];
    ClothPicture picture = cloth_picture(state, i, kFilmDirections);
    if (transparent) {
      picture.background.alpha = 0.0;
      picture.ground.shown = false;
    }
    if (state.settings.arrows && i < state.snapshot().cloths.size())
      add_pull_arrows(state.cloths->scene(i), readings_of(state.snapshot().cloths[i]), picture);
    if (picture.colour_bar) {
      const ViewQuantity& q = view_quantities()[static_cast<std::size_t>(state.settings.heat_map)];
      const ViewUnit& unit = q.unit(state.settings.units);
      picture.colour_bar->title = std::string(state.text(q.name)) + " [" + unit.text + "]";
      picture.colour_bar->low /= unit.to_si;
      picture.colour_bar->high /= unit.to_si;
      for (ClothItem& cloth : picture.cloths)
        for (double& value : cloth.mesh.values) value /= unit.to_si;
    }
    if (caption) {
      const ViewFabric& fabric = state.built.fabrics[i];
      char time[48];
      std::snprintf(time, sizeof time, ", %.3f s, fuai %s", state.snapshot().time, version_.c_str());
      picture.caption = fabric.measured.name +
                        (fabric.changed() ? std::string(" (") + state.text(TextId::kChanged) + ")" : "") +
                        "\n" + state.built.scene + time;
    }
    painter.paint(picture, target.begin_tile(tile), tile.width, tile.height);
    target.end_tile(tile);
    Image image = target.read(tile);
    make_alpha_straight(image);
    images.push_back(draw_overlay(image, picture));
  }
  return tile_images(images, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(images.size())))));
}

void ViewerFiles::screenshot(ViewerState& state, ScreenTarget& target, ClothPainter& painter) {
  try_files(state, [&] {
    const std::string path = free_name("fuai", ".png");
    write_atomically(path, encode_png(cloths_image(state, target, painter, state.settings.caption,
                                                   state.settings.transparent)));
    state.say(path + ": " + state.text(TextId::kSaved));
  });
}

void ViewerFiles::toggle_video(ViewerState& state) {
  if (video_) {
    const std::string path = video_->path();
    video_.reset();
    state.say(path + ": " + state.text(TextId::kSaved));
  } else {
    try_files(state, [&] {
      const ViewBox view = lay_out(state).view;
      const auto even = [](float length) { return static_cast<int>(length) / 2 * 2; };
      video_ = std::make_unique<Video>(free_name("fuai-video", ""),
                                       ScreenTile{static_cast<int>(view.left), static_cast<int>(view.top),
                                                  even(view.width), even(view.height)});
      if (!video_->is_film()) state.say(state.text(TextId::kNoFfmpeg));
    });
  }
  state.filming = video_ != nullptr;
}

void ViewerFiles::start_recording(ViewerState& state, const std::string& path) {
  recording_ = std::make_unique<ViewLogWriter>(path, state.built);
  recording_path_ = path;
  lost_before_ = state.session->lost_events();
  state.recording = true;
}

void ViewerFiles::toggle_recording(ViewerState& state) {
  if (recording_ && !recording_->begun()) {  // its cloths are on their way: once more with the next picture
    ++state.wishes.record;
    return;
  }
  if (recording_) {
    recording_.reset();
    state.recording = false;
    state.say(recording_path_ + ": " + state.text(TextId::kSaved));
    return;
  }
  try_files(state, [&] {
    const std::string path = free_name("fuai", kViewLogEnding);
    // A recording begins where new cloths take over.
    start_recording(state, path);
    restart_cloths(state);
    setup_changed(state);
    state.say(path + ": " + state.text(TextId::kRecording));
  });
}

void ViewerFiles::toggle_force_log(ViewerState& state) {
  if (forces_) {
    forces_.reset();
    state.say(forces_path_ + ": " + state.text(TextId::kSaved));
  } else {
    try_files(state, [&] {
      forces_path_ = free_name("fuai-forces", ".csv");
      forces_ = std::make_unique<ForceLog>(forces_path_);
      state.say(forces_path_ + ": " + state.text(TextId::kRecording));
    });
  }
  state.logging = forces_ != nullptr;
}

void ViewerFiles::save_fabric(ViewerState& state) {
  try_files(state, [&] {
    const ViewFabric& fabric = state.built.fabrics[shown_fabric(state)];
    const Fabric scaled = scaled_fabric(fabric);
    const std::string path = free_name(scaled.id.empty() ? "fabric" : scaled.id, ".fabric.toml");
    write_fabric_file(path, scaled);
    state.say(path + ": " + state.text(TextId::kSaved));
  });
}

void ViewerFiles::serve(ViewerState& state, ScreenTarget& target, ClothPainter& painter) {
  const ViewWishes& wishes = state.wishes;
  if (wishes.screenshot > 0) screenshot(state, target, painter);
  if (wishes.video > 0) toggle_video(state);
  if (wishes.record > 0) toggle_recording(state);
  if (wishes.force_log) toggle_force_log(state);
  if (wishes.save > 0) save_fabric(state);
  const std::size_t shown = shown_fabric(state);
  const std::string name = state.built.fabrics[shown].measured.id;
  const auto export_mesh = [&](const char* ending, const auto& bytes_of) {
    try_files(state, [&] {
      const std::string path = free_name("fuai", ending);
      write_atomically(path, bytes_of(state.meshes[shown].mesh));
      state.say(path + ": " + state.text(TextId::kSaved));
    });
  };
  if (wishes.obj) export_mesh(".obj", [&](const SurfaceMesh& mesh) { return mesh_obj(mesh, name); });
  if (wishes.gltf) export_mesh(".glb", [&](const SurfaceMesh& mesh) { return mesh_glb(mesh, name); });
}

void ViewerFiles::setup_changed(ViewerState& state) {
  if (recording_) try_files(state, [&] { recording_->announce(state.session->newest_build(), state.built); });
}

void ViewerFiles::follow_events(ViewerState& state) {
  std::int64_t rewound_to = -1;
  const std::vector<ViewEvent> events = state.session->take_events(rewound_to);
  if (!recording_) return;
  if (state.session->lost_events() != lost_before_)
    throw Error(ErrorKind::kBadInput, "events of the cloths were lost; the recording ends here", {},
                "record again");
  recording_->write(events, rewound_to);
}

void ViewerFiles::follow_forces(const ViewerState& state) {
  std::vector<std::string> names;
  for (const ViewFabric& fabric : state.built.fabrics) names.push_back(fabric.measured.name);
  forces_->write(state.snapshot(), names);
}

void ViewerFiles::follow(ViewerState& state, const ScreenTarget& target) {
  // What failed once is ended: with a gap the rest is worth nothing, and once is enough to tell.
  if (!try_files(state, [&] { follow_events(state); })) recording_.reset();
  if (forces_ && !try_files(state, [&] { follow_forces(state); })) forces_.reset();
  if (video_ && !try_files(state, [&] { video_->follow(state.snapshot().time, target); })) video_.reset();
  state.recording = recording_ != nullptr;
  state.logging = forces_ != nullptr;
  state.filming = video_ != nullptr;
}

}  // namespace fuai
