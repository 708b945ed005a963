// The cloths with the user's hands on them: what a command does, what a step does, and freezing all of it.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "How it works".
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "fuai/core/team.h"
#include "fuai/viewer/view_session.h"

namespace fuai {

/// A hand of the user; the same on all cloths.
struct ViewHand {
  bool holds = false;
  Vec3 target = Vec3::Zero();  ///< where it is [m]
  Vec3 goal = Vec3::Zero();    ///< where it goes [m]
  std::uint16_t left = 0;      ///< steps until it is there
  std::uint32_t order = 0;     ///< the larger, the later it gripped
};

/// What is true of all cloths at once.
struct ViewHands {
  std::array<ViewHand, kMostViewHands> hands;
  std::uint32_t grips = 0;   ///< so far
  bool scene_moves = false;  ///< the scene's own hands and pins do
  double scene_time = 0.0;   ///< of their motion, which stands still when they do [s]
};

/// Which hold of its simulation each hand has on one cloth; -1: none.
struct ClothHolds {
  ClothHolds() noexcept { user.fill(-1); }
  std::array<int, kMostViewHands> user{};
  SceneHolds scene;
};

/// A stage, frozen: restore() of it goes on bit for bit.
struct KeptStage {
  struct Cloth {
    ClothState state;
    ClothHolds holds;
    std::array<std::optional<Grasp>, kMostViewHands + kMostHands> grasps;  ///< by number of the hold
  };
  std::int64_t tick = -1;
  ViewHands hands;
  std::vector<Cloth> cloths;
};

/// The stage.
class ViewStage {
 public:
  /// As the scene starts. Thread class: set-up.
  explicit ViewStage(std::shared_ptr<ViewCloths> cloths);

  /// Does a command; one that makes no sense (no such hand, not finite) does nothing. Thread class:
  /// real-time.
  void apply(const ViewCommand& command) noexcept;
  /// Whether apply() would do something. Thread class: real-time.
  bool makes_sense(const ViewCommand& command) const noexcept;
  /// What the hand of a device has to do to be where it is; it takes hold of that cloth where it is near.
  /// Thread class: real-time.
  std::optional<ViewCommand> command_of(const DevicePose& device, std::size_t cloth) const noexcept;
  /// What it feels of a cloth. Thread class: real-time.
  GraspReading device_reading(std::size_t cloth) const noexcept;
  /// As ClothSimulation::stored_energy(). Thread class: real-time.
  double stored_energy(std::size_t cloth) const {
    return simulation(cloth).stored_energy(each_[cloth].scratch);
  }
  /// Whether the next step moves something else that holds the cloth. Thread class: real-time.
  bool is_driven() const noexcept;
  /// One tick of kViewStep. Thread class: real-time.
  void step(Team* team) noexcept;
  /// Thread class: real-time when `kept` was filled before.
  void keep(KeptStage& kept) const;
  /// Of a stage of the same cloths. Thread class: as ClothSimulation::restore().
  void restore(const KeptStage& kept);
  /// Goes on from where another stage is, cloth by cloth where scene, lattice and pins are the same.
  /// Thread class: set-up.
  void take_shape_of(const ViewStage& other);

  std::size_t size() const noexcept { return cloths_->size(); }
  /// Nodes of each cloth, which decides what kept stages need.
  std::vector<std::size_t> slot_counts() const;
  /// Positions and hands into a snapshot that has size() cloths. @param field -1: none  @param energies also
  /// energies and strain, which cost as much as a step. Thread class: real-time once the snapshot has been
  /// filled before.
  void show(int field, bool energies, ViewSnapshot& snapshot);
  /// Hash over the states of all cloths. Thread class: real-time.
  std::uint64_t hash() const;

 private:
  struct Cloth {
    ClothHolds holds;
    mutable ClothState scratch;
    std::uint64_t failed_steps = 0;
  };
  ClothSimulation& simulation(std::size_t cloth) const noexcept;
  void grab(const ViewCommand& command) noexcept;
  void release(std::size_t hand) noexcept;
  void start_again() noexcept;
  void set_motion(bool moves) noexcept;
  void move_hands() noexcept;
  int last_hand() const noexcept;
  void show_cloth(std::size_t cloth, int field, bool energies, ClothView& view);

  std::shared_ptr<ViewCloths> cloths_;
  std::vector<Cloth> each_;
  ViewHands hands_;
};

}  // namespace fuai
