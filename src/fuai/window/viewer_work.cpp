// Builds, follows, opens.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer_work.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/core/error.h"
#include "fuai/experiments/scene_pictures.h"
#include "fuai/io/fabric_import.h"
#include "fuai/io/text_file.h"
#include "fuai/io/threshold_file.h"
#include "fuai/scenes/catalogue.h"
#include "fuai/window/ui_style.h"
#include "fuai/window/viewer_replay.h"

namespace fuai {
namespace {

/// Laws, numbers and differences of the fabrics.
void study_fabrics(ViewerState& state) {
  const std::vector<ViewFabric>& fabrics = state.document.setup().fabrics;
  state.laws.clear();
  state.numbers.clear();
  state.comparison.reset();
  std::vector<Fabric> measured;
  for (const ViewFabric& fabric : fabrics) {
    state.laws.push_back(make_view_laws(fabric));
    state.numbers.push_back(fabric_numbers(fabric.measured, make_fabric_laws(fabric.measured)));
    measured.push_back(fabric.measured);
  }
  if (measured.size() > 1) state.comparison = compare_fabrics(measured, bundled_thresholds());
}

/// Surfaces of new cloths, where they start.
void make_meshes(ViewerState& state) {
  state.meshes.clear();
  for (std::size_t i = 0; i < state.cloths->size(); ++i) {
    const EngineScene& scene = state.cloths->scene(i);
    state.meshes.push_back(make_piece_mesh(scene.model, scene.start.positions));
  }
  state.vertex_values.assign(state.meshes.size(), {});
}

bool same_lattice(const ViewSetup& a, const ViewSetup& b) {
  return a.scene == b.scene && a.size.size == b.size.size && a.size.spacing == b.size.spacing;
}

void tell_refusal(ViewerState& state, const Error& e) {
  state.say(std::string(state.text(TextId::kNotOpened)) + ": " + state.text(e) + " (" +
                state.text(TextId::kNothingChanged) + ")",
            true);
}

/// Runs a change of the document; what it throws is told.
template <class Change>
void try_change(ViewerState& state, const Change& change) {
  try {
    ViewSetup setup = state.document.setup();
    change(setup);
    state.document.change(std::move(setup));
  } catch (const Error& e) {
    tell_refusal(state, e);
  }
}

/// The same for a fabric of the table: one that was switched.
template <class Change>
void change_fabric(ViewerState& state, std::size_t place, const Change& change) {
  const std::uint64_t before = state.document.version();
  try_change(state, [&](ViewSetup& setup) { change(setup.fabrics[place]); });
  if (state.document.version() != before) state.steps.did(FirstStep::kSwitch);
}

/// Values of slots at the vertices; not a number where a slot has none.
void spread_values(const PieceMesh& piece, const std::vector<double>& slots, std::vector<double>& values) {
  values.resize(piece.vertices.size());
  for (std::size_t v = 0; v < piece.vertices.size(); ++v) {
    const MaterialPoint& point = piece.vertices[v];
    double sum = 0.0, weight = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      const double value = slots[static_cast<std::size_t>(point.slots[i])];
      if (point.weights[i] == 0.0 || !std::isfinite(value)) continue;
      sum += point.weights[i] * value;
      weight += point.weights[i];
    }
    values[v] = weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
  }
}

/// A fabric takes the place of another one; a curve that of what is known of its test, and the rest stays.
void open_file(ViewFabric& fabric, const std::string& path) {
  if (!is_curve_file(path)) {
    fabric = load_view_fabric(path);
    return;
  }
  const auto factors = fabric.factors;
  fabric = load_view_fabric(with_curve(fabric.source, path));
  fabric.factors = factors;
}

/// What a hand of a moment feels of a cloth [N].
double force_on(const ClothView& cloth, int hand) {
  if (hand < 0) return 0.0;
  const GraspReading& reading =
      hand == kSceneHand ? cloth.scene_hands.front() : cloth.hands[static_cast<std::size_t>(hand)];
  return reading.holds ? reading.force.norm() : 0.0;
}

void remember_forces(ViewerState& state) {
  const ViewSnapshot& snapshot = state.snapshot();
  while (!state.forces.empty() && state.forces.back().time >= snapshot.time) state.forces.pop_back();
  while (!state.forces.empty() && state.forces.front().time < snapshot.time - kForceSeconds)
    state.forces.pop_front();
  ForceMoment moment;
  moment.time = snapshot.time;
  moment.hand = state.hands.last();
  // The mouse's hand, else that of the device or of a recording, else the scene's own.
  const bool led = moment.hand < 0;
  const ClothView& first = snapshot.cloths.front();
  for (std::size_t i = 0; i < kMostViewHands && moment.hand < 0; ++i)
    if ((i == kDeviceHand || state.replay) && first.hands[i].holds) moment.hand = static_cast<int>(i);
  if (moment.hand < 0 && first.scene_hands.front().holds) moment.hand = kSceneHand;
  for (const ClothView& cloth : snapshot.cloths) {
    moment.forces.push_back(force_on(cloth, moment.hand));
    moment.probes.push_back(cloth.probe);
    moment.probed = moment.probed || cloth.probed;
  }
  if (led && moment.hand >= 0) {
    // Where the scene's hand is nobody tells: the cloth that it holds is there but for what its hold gives.
    const Vec3& place = moment.hand == kSceneHand ? first.scene_hands.front().centre
                                                  : first.targets[static_cast<std::size_t>(moment.hand)];
    if (state.forces.empty() || state.forces.back().hand != moment.hand) state.led_start = place;
    moment.way = (place - state.led_start).norm();
  } else if (moment.hand >= 0) {
    const UserHand& own = state.hands.hand(static_cast<std::size_t>(moment.hand));
    moment.way = (own.target - own.start).norm();
  }
  state.forces.push_back(std::move(moment));
}

}  // namespace

const std::vector<Vec3>& ViewerState::slot_positions(std::size_t cloth) const {
  const std::vector<Vec3>& start = cloths->scene(cloth).start.positions;
  const ViewSnapshot& s = snapshot();
  if (cloth >= s.cloths.size() || s.cloths[cloth].positions.size() != start.size()) return start;
  return s.cloths[cloth].positions;
}

ViewSetup make_view_setup(const std::string& scene, const std::vector<std::string>& fabrics,
                          const SceneOptions& size) {
  ViewSetup setup;
  setup.scene = scene;
  setup.size = size;
  if (find_scene(scene).kind != SceneKind::kEngine) {
    throw Error(ErrorKind::kUsage, "'" + scene + "' is a scene of the paper's method, which has no time", {},
                "take corner_drape or bending");
  }
  if (fabrics.empty() || fabrics.size() > kMostViewFabrics) {
    throw Error(ErrorKind::kUsage, "the viewer shows one to " + std::to_string(kMostViewFabrics) + " fabrics",
                {}, "name fewer");
  }
  for (const std::string& source : fabrics) setup.fabrics.push_back(load_view_fabric(source));
  return setup;
}

void begin_session(ViewerState& state) {
  study_fabrics(state);
  state.cloths = std::make_shared<ViewCloths>(state.document.setup());
  state.session = std::make_unique<ViewSession>(state.cloths);
  state.built_version = state.document.version();
  state.built = state.document.setup();
  make_meshes(state);
}

void meet_device(ViewerState& state, const DeviceInfo& device) {
  state.device.model = device.model;
  state.device.gives_force = device.peak_force > 0.0;
  if (!state.device.gives_force) return;
  ViewSetup setup = state.document.setup();
  setup.felt = true;
  state.document = ViewDocument(std::move(setup));  // nothing was done that could be undone
  begin_session(state);
}

bool follow_document(ViewerState& state) {
  if (state.built_version == state.document.version()) return false;
  state.built_version = state.document.version();
  try {
    const bool keep = same_lattice(state.built, state.document.setup());
    take_cloths(state, std::make_shared<ViewCloths>(state.document.setup()), keep);
    state.replay.reset();  // a change of the user's ends it
    return true;
  } catch (const Error& e) {
    state.say(state.text(e) + " (" + state.text(TextId::kNothingChanged) + ")", true);
    state.document.change(state.built);  // what is seen
    state.built_version = state.document.version();
    study_fabrics(state);
    return false;
  }
}

std::uint64_t take_cloths(ViewerState& state, std::shared_ptr<ViewCloths> cloths, bool keep,
                          std::shared_ptr<const ViewScript> script) {
  study_fabrics(state);
  state.cloths = std::move(cloths);
  state.built = state.document.setup();
  state.built_version = state.document.version();
  const std::uint64_t build = state.session->replace(state.cloths, keep, std::move(script));
  if (!keep) state.forces.clear();
  for (ForceMoment& moment : state.forces) moment.probed = false;  // of other laws
  make_meshes(state);
  return build;
}

void restart_cloths(ViewerState& state) {
  state.cloths = std::make_shared<ViewCloths>(state.built);
  state.session->replace(state.cloths, false);
  state.hands.forget();
  state.forces.clear();
}

bool take_snapshot(ViewerState& state) {
  state.session->show_field(state.settings.heat_map);
  if (!state.session->fetch()) return false;
  const ViewSnapshot& snapshot = state.snapshot();
  if (snapshot.cloths.size() != state.meshes.size()) return true;  // of cloths that were replaced
  for (std::size_t i = 0; i < state.meshes.size(); ++i) {
    const ClothView& view = snapshot.cloths[i];
    if (view.positions.size() != static_cast<std::size_t>(state.cloths->scene(i).model.slot_count()))
      return true;
    update_piece_mesh(state.meshes[i], view.positions);
    state.vertex_values[i].clear();
    if (!view.field.empty()) spread_values(state.meshes[i], view.field, state.vertex_values[i]);
  }
  state.hands.follow(snapshot);
  remember_forces(state);
  return true;
}

void frame_view(ViewerState& state) {
  const SceneView& view = state.cloths->scene(0).view;
  Bounds bounds;
  bounds.include(view.low);
  bounds.include(view.high);
  const double aspect =
      state.tiles.empty() ? 1.5 : static_cast<double>(state.tiles[0].width) / state.tiles[0].height;
  state.camera.frame(bounds, view.azimuth, view.elevation, aspect);
}

void look_at_cloth(ViewerState& state) {
  const std::vector<Vec3>& places = state.meshes.front().mesh.positions;
  Vec3 middle = Vec3::Zero();
  for (const Vec3& p : places) middle += p / static_cast<double>(places.size());
  state.camera.look_at(
      *std::ranges::min_element(places, {}, [&](const Vec3& p) { return (p - middle).squaredNorm(); }));
}

std::string lay_texture(ViewerState& state, const std::string& path, double width) {
  try {
    state.texture = std::make_shared<const Image>(decode_png(read_bytes(path), path));
    state.texture_width = width;
    return {};
  } catch (const Error& e) {
    state.say(state.text(e), true);
    return e.what();
  }
}

void add_view_fabric(ViewerState& state, const std::string& source) {
  const std::size_t before = state.document.setup().fabrics.size();
  try_change(state, [&](ViewSetup& setup) { setup.fabrics.push_back(load_view_fabric(source)); });
  if (state.document.setup().fabrics.size() == before) return;
  state.turn_to = before;
  state.steps.did(FirstStep::kCompare);
}

void set_view_fabric(ViewerState& state, std::size_t place, const std::string& source) {
  change_fabric(state, place, [&](ViewFabric& fabric) { fabric = load_view_fabric(source); });
}

void remove_view_fabric(ViewerState& state, std::size_t place) {
  try_change(state, [&](ViewSetup& setup) {
    if (setup.fabrics.size() > 1)
      setup.fabrics.erase(setup.fabrics.begin() + static_cast<std::ptrdiff_t>(place));
  });
}

void set_view_scene(ViewerState& state, const std::string& scene) {
  try_change(state, [&](ViewSetup& setup) { setup.scene = scene; });
}

void open_path(ViewerState& state, const std::string& path) {
  if (path.ends_with(kViewLogEnding)) {
    try {
      open_replay(state, path);
    } catch (const Error& e) {
      tell_refusal(state, e);
    }
    return;
  }
  const std::size_t place = std::min(state.page, state.document.setup().fabrics.size() - 1);
  change_fabric(state, place, [&](ViewFabric& fabric) { open_file(fabric, path); });
}

HeatRange heat_range(const ViewerState& state) {
  const auto& quantity = view_quantities()[static_cast<std::size_t>(std::max(state.settings.heat_map, 0))];
  double most = quantity.least_range;
  if (state.settings.auto_range) {
    for (const std::vector<double>& values : state.vertex_values)
      for (const double v : values)
        if (std::isfinite(v)) most = std::max(most, std::abs(v));
  } else {
    most = std::max(state.settings.range, 1e-12);
  }
  return {is_signed(quantity.field) ? -most : 0.0, most};
}

ClothPicture cloth_picture(const ViewerState& state, std::size_t cloth, int ambient_directions) {
  const ViewSettings& settings = state.settings;
  const EngineScene& scene = state.cloths->scene(cloth);
  ClothPicture picture = scene_stage_picture(scene, state.slot_positions(cloth));
  picture.camera = state.camera.camera();
  picture.ambient_directions = ambient_directions;
  picture.background = background_colour(settings.dark);
  picture.ground.shown = settings.ground && picture.camera.eye.z() > picture.ground.height;
  picture.ground.colour = ground_colour(settings.dark);
  ClothItem item;
  item.mesh = state.meshes[cloth].mesh;
  item.thread_spacing = settings.lines ? scene.model.spacing : 0.0;
  if (settings.yarns) item.yarns = yarns_of(state.built.fabrics[cloth].measured);
  item.texture = state.texture;
  item.texture_width = state.texture_width;
  if (settings.heat_map >= 0 && !state.vertex_values[cloth].empty()) {
    const HeatRange range = heat_range(state);
    item.mesh.values = state.vertex_values[cloth];
    const auto field = static_cast<ClothField>(settings.heat_map);
    picture.colour_bar = ColourBar{"", range.low, range.high,
                                   is_signed(field) ? ColourMap::kDiverging : ColourMap::kSequential};
  }
  picture.cloths.push_back(std::move(item));
  return picture;
}

}  // namespace fuai
