// Hands on cloths.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_stage.h"

#include <algorithm>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/scenes/catalogue.h"
#include "fuai/sim/felt_options.h"
#include "fuai/solver/cloth_energy.h"

namespace fuai {
namespace {

bool same_cut(const EngineScene& a, const EngineScene& b) {
  const ClothModel &m = a.model, &n = b.model;
  return a.name == b.name && m.columns == n.columns && m.rows == n.rows && m.spacing == n.spacing &&
         m.origin == n.origin && m.live == n.live && m.fixed == n.fixed;
}

}  // namespace

ViewCloths::ViewCloths(const ViewSetup& setup) : scene_moves_(setup.scene_moves) {
  if (setup.fabrics.empty() || setup.fabrics.size() > kMostViewFabrics) {
    throw Error(ErrorKind::kUsage, std::to_string(setup.fabrics.size()) + " fabrics cannot be shown", {},
                "take 1 to " + std::to_string(kMostViewFabrics));
  }
  for (const ViewFabric& fabric : setup.fabrics) {
    EngineScene scene = make_engine_scene(setup.scene, make_view_laws(fabric), setup.size);
    if (setup.felt) scene.options.implicit = make_felt_options(scene.options.implicit);
    scene.options.most_grasps = static_cast<int>(kMostViewHands + kMostHands);
    scenes_.push_back(std::make_unique<const EngineScene>(std::move(scene)));
    runs_.push_back(std::make_unique<SceneRun>(*scenes_.back()));
  }
}

ViewStage::ViewStage(std::shared_ptr<ViewCloths> cloths) : cloths_(std::move(cloths)) {
  each_.resize(cloths_->size());
  for (std::size_t c = 0; c < size(); ++c) {
    simulation(c).restore(cloths_->scene(c).start);
    simulation(c).snapshot(each_[c].scratch);
    each_[c].scratch.carried.reserve(64);  // what a solver carries comes and goes
  }
  hands_.scene_moves = cloths_->scene_moves();
}

ClothSimulation& ViewStage::simulation(std::size_t cloth) const noexcept {
  return cloths_->run(cloth).simulation();
}

std::vector<std::size_t> ViewStage::slot_counts() const {
  std::vector<std::size_t> counts;
  for (std::size_t c = 0; c < size(); ++c)
    counts.push_back(static_cast<std::size_t>(cloths_->scene(c).model.slot_count()));
  return counts;
}

bool ViewStage::makes_sense(const ViewCommand& command) const noexcept {
  const bool about_hand = command.kind == ViewCommand::Kind::kGrab ||
                          command.kind == ViewCommand::Kind::kMove ||
                          command.kind == ViewCommand::Kind::kRelease;
  if (!about_hand) return true;
  if (command.hand >= kMostViewHands) return false;
  if (command.kind != ViewCommand::Kind::kGrab && !hands_.hands[command.hand].holds) return false;
  if (command.kind == ViewCommand::Kind::kRelease) return true;
  return command.position.allFinite() && command.material.allFinite() && command.radius >= 0.0 &&
         command.radius <= kMostPatchRadius && command.stiffness >= kLeastHoldStiffness &&
         command.stiffness <= kMostHoldStiffness;
}

void ViewStage::apply(const ViewCommand& command) noexcept {
  if (!makes_sense(command)) return;
  switch (command.kind) {
    case ViewCommand::Kind::kGrab:
      return grab(command);
    case ViewCommand::Kind::kMove: {
      ViewHand& hand = hands_.hands[command.hand];
      hand.goal = command.position;
      hand.left = std::max<std::uint16_t>(command.ticks, 1);
      return;
    }
    case ViewCommand::Kind::kRelease:
      return release(command.hand);
    case ViewCommand::Kind::kReset:
      return start_again();
    case ViewCommand::Kind::kMotion:
      return set_motion(command.flag);
  }
}

void ViewStage::grab(const ViewCommand& command) noexcept {
  release(command.hand);
  GraspSpec spec;
  spec.centre = command.material;
  spec.radius = command.radius;
  spec.stiffness = command.stiffness;
  ViewHand& hand = hands_.hands[command.hand];
  for (std::size_t c = 0; c < size(); ++c) {
    int& hold = each_[c].holds.user[command.hand];
    hold = simulation(c).grasp(spec, command.position);
    hand.holds = hand.holds || hold >= 0;
  }
  if (!hand.holds) return;  // no cloth there
  hand.target = hand.goal = command.position;
  hand.left = 0;
  hand.order = ++hands_.grips;
}

void ViewStage::release(std::size_t hand) noexcept {
  for (std::size_t c = 0; c < size(); ++c)
    simulation(c).release(std::exchange(each_[c].holds.user[hand], -1));
  hands_.hands[hand] = {};
}

void ViewStage::start_again() noexcept {
  for (std::size_t c = 0; c < size(); ++c) {
    simulation(c).restore(cloths_->scene(c).start);  // lets all holds go
    each_[c].holds = {};
    each_[c].failed_steps = 0;
  }
  const bool moves = hands_.scene_moves;
  hands_ = {};
  hands_.scene_moves = moves;
}

void ViewStage::set_motion(bool moves) noexcept {
  hands_.scene_moves = moves;
  if (moves) return;
  for (std::size_t c = 0; c < size(); ++c)
    for (int& hold : each_[c].holds.scene.holds) simulation(c).release(std::exchange(hold, -1));
}

std::optional<ViewCommand> ViewStage::command_of(const DevicePose& device, std::size_t cloth) const noexcept {
  const ViewHand& hand = hands_.hands[kDeviceHand];
  ViewCommand command;
  command.hand = static_cast<std::uint8_t>(kDeviceHand);
  command.position = device.position;
  if (hand.holds) {
    const bool jumps = !((device.position - hand.goal).norm() <= device.reach);
    if (device.position == hand.goal && device.holds) return std::nullopt;
    command.kind = device.holds && !jumps ? ViewCommand::Kind::kMove : ViewCommand::Kind::kRelease;
    command.ticks = 1;
    return command;
  }
  if (!device.holds) return std::nullopt;
  const std::optional<Vec2> near = simulation(cloth).free_cloth_near(device.position, device.reach);
  if (!near) return std::nullopt;
  command.kind = ViewCommand::Kind::kGrab;
  command.material = *near;
  command.stiffness = device.stiffness;
  return command;
}

GraspReading ViewStage::device_reading(std::size_t cloth) const noexcept {
  return simulation(cloth).grasp_reading(each_[cloth].holds.user[kDeviceHand]);
}

bool ViewStage::is_driven() const noexcept {
  if (hands_.scene_moves) return true;
  for (std::size_t h = 0; h < kDeviceHand; ++h)
    if (hands_.hands[h].left > 0) return true;
  return false;
}

void ViewStage::move_hands() noexcept {
  for (std::size_t h = 0; h < kMostViewHands; ++h) {
    ViewHand& hand = hands_.hands[h];
    if (hand.left == 0) continue;
    // The last step lands on the goal exactly.
    hand.target = hand.left == 1 ? hand.goal : Vec3(hand.target + (hand.goal - hand.target) / hand.left);
    --hand.left;
    for (std::size_t c = 0; c < size(); ++c) simulation(c).move_grasp(each_[c].holds.user[h], hand.target);
  }
}

void ViewStage::step(Team* team) noexcept {
  move_hands();
  const auto step_cloth = [&](std::size_t c) {
    const StepReport report =
        hands_.scene_moves
            ? drive_from(hands_.scene_time, simulation(c), cloths_->scene(c), each_[c].holds.scene, kViewStep)
            : simulation(c).step(kViewStep);
    if ((report.status & StepReport::kNotFinite) != 0) ++each_[c].failed_steps;
  };
  const int members = team == nullptr ? 1 : team->size(), count = static_cast<int>(size());
  run_together(count > 1 ? team : nullptr, [&](int member) {
    const Share share = share_of(count, member, count > 1 ? members : 1);
    for (int c = share.begin; c < share.end; ++c) step_cloth(static_cast<std::size_t>(c));
  });
  if (hands_.scene_moves) hands_.scene_time += kViewStep;
}

void ViewStage::keep(KeptStage& kept) const {
  kept.hands = hands_;
  kept.cloths.resize(size());
  for (std::size_t c = 0; c < size(); ++c) {
    KeptStage::Cloth& cloth = kept.cloths[c];
    simulation(c).snapshot(cloth.state);
    cloth.holds = each_[c].holds;
    for (std::size_t i = 0; i < cloth.grasps.size(); ++i) {
      const Grasp* grasp = simulation(c).held(static_cast<int>(i));
      if (grasp != nullptr) {
        cloth.grasps[i] = *grasp;
      } else {
        cloth.grasps[i].reset();
      }
    }
  }
}

void ViewStage::restore(const KeptStage& kept) {
  hands_ = kept.hands;
  for (std::size_t c = 0; c < size(); ++c) {
    const KeptStage::Cloth& cloth = kept.cloths[c];
    simulation(c).restore(cloth.state);
    each_[c].holds = cloth.holds;
    for (std::size_t i = 0; i < cloth.grasps.size(); ++i)
      if (cloth.grasps[i]) simulation(c).take_over_as(static_cast<int>(i), *cloth.grasps[i]);
  }
}

void ViewStage::take_shape_of(const ViewStage& other) {
  bool any = false;
  for (std::size_t c = 0; c < size(); ++c) {
    const std::size_t from = c < other.size() ? c : 0;
    if (!same_cut(cloths_->scene(c), other.cloths_->scene(from))) continue;
    any = true;
    ClothState& state = each_[c].scratch;  // sized for this cloth already
    other.simulation(from).snapshot(state);
    // Known of the old material only.
    state.carried.clear();
    std::ranges::fill(state.accelerations, Vec3::Zero());
    simulation(c).restore(state);
    each_[c].holds = other.each_[from].holds;
    for (int i = 0; i < static_cast<int>(kMostViewHands + kMostHands); ++i) {
      const Grasp* grasp = other.simulation(from).held(i);
      if (grasp != nullptr) simulation(c).take_over_as(i, *grasp);
    }
  }
  if (!any) return;
  hands_ = other.hands_;
  set_motion(cloths_->scene_moves());
}

int ViewStage::last_hand() const noexcept {
  int last = -1;
  for (std::size_t h = 0; h < kMostViewHands; ++h) {
    const ViewHand& hand = hands_.hands[h];
    if (hand.holds && (last < 0 || hand.order > hands_.hands[static_cast<std::size_t>(last)].order))
      last = static_cast<int>(h);
  }
  return last;
}

void ViewStage::show(int field, bool energies, ViewSnapshot& snapshot) {
  snapshot.cloths.resize(size());
  for (std::size_t c = 0; c < size(); ++c) show_cloth(c, field, energies, snapshot.cloths[c]);
  snapshot.time = simulation(0).time();
}

void ViewStage::show_cloth(std::size_t cloth, int field, bool energies, ClothView& view) {
  const EngineScene& scene = cloths_->scene(cloth);
  const ClothSimulation& sim = simulation(cloth);
  Cloth& own = each_[cloth];
  const auto slots = static_cast<std::size_t>(scene.model.slot_count());
  view.positions.resize(slots);
  for (std::size_t slot = 0; slot < slots; ++slot)
    view.positions[slot] = sim.position(static_cast<int>(slot));
  for (std::size_t h = 0; h < kMostViewHands; ++h) {
    view.hands[h] = sim.grasp_reading(own.holds.user[h]);
    view.targets[h] = hands_.hands[h].target;
  }
  for (std::size_t h = 0; h < kMostHands; ++h)
    view.scene_hands[h] = sim.grasp_reading(own.holds.scene.holds[h]);
  view.clamp_force = sim.clamp_force();
  view.failed_steps = own.failed_steps;
  const int last = last_hand();
  const Grasp* grasp = last < 0 ? nullptr : sim.held(own.holds.user[static_cast<std::size_t>(last)]);
  view.probed = grasp != nullptr;
  const bool has_field = field >= 0 && field < kClothFieldCount;
  view.field.resize(has_field ? slots : 0);
  if (!has_field && !view.probed && !energies) return;
  sim.snapshot(own.scratch);
  if (has_field)
    evaluate_field(scene.model, scene.material, own.scratch, static_cast<ClothField>(field), view.field);
  if (view.probed)
    view.probe = probe_cloth(scene.model, scene.material, own.scratch, grasp->slots(), grasp->weights());
  if (!energies) return;
  view.energy = cloth_free_energy(scene.model, scene.material, own.scratch, scene.options.implicit.gravity);
  view.kinetic_energy = cloth_kinetic_energy(scene.model, own.scratch);
  view.max_strain = max_edge_strain(scene.model, own.scratch);
}

std::uint64_t ViewStage::hash() const {
  StateHash all;
  for (std::size_t c = 0; c < size(); ++c) {
    simulation(c).snapshot(each_[c].scratch);
    const std::uint64_t one = fuai::state_hash(each_[c].scratch);
    all.add(&one, sizeof one);
  }
  return all.value();
}

}  // namespace fuai
