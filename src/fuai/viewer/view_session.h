// The cloths of the viewer in time: what the hands of the user do to them, tick by tick, and what is shown.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "How it works".
//
//   screen's thread                                   cloth's thread (runtime/paced_thread.h)
//     send(command)       ---- queue --------->         tick(): takes commands, steps all cloths by dt
//     fetch(), snapshot() <--- mailbox --------         puts a snapshot every kSnapshotPeriod
//     take_events()       <--- queue ----------         what was done at which tick, for the recording
//
//   Nobody waits for anybody. All cloths get the same commands at the same tick. A tick depends on the cloths
//   and the commands taken at it only: the events, fed to a fresh session at their ticks, give the same bits.
//   Twice a second of simulated time the whole state is kept, for kKeptSeconds or as long as the memory set
//   aside lasts: seek() goes back to the last one before a tick and steps again from there, with the commands
//   that were done, a few steps a round so that the cloth's thread goes on listening.
//
//   A command is done at the beginning of a tick, before its step. While the session is paused at a tick,
//   commands belong to this tick: they are done at once and stay when the session goes on. What happened at
//   later ticks is forgotten then.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "fuai/scenes/engine_scene.h"
#include "fuai/sim/cloth_fields.h"
#include "fuai/viewer/view_setup.h"

namespace fuai {

/// Hands of the user on each cloth, pins among them; the scene's own hands come besides.
inline constexpr std::size_t kMostViewHands = 16;
/// The last of them is that of a device (DevicePose), the others are the mouse's.
inline constexpr std::size_t kDeviceHand = kMostViewHands - 1;
inline constexpr double kViewStep = 0.001;  ///< dt of a tick [s]
inline constexpr double kSnapshotPeriod =
    1.0 / 120.0;  ///< of simulated or of wall time, whichever is longer [s]
inline constexpr int kKeptSeconds = 20;
inline constexpr std::int64_t kKeptTicks = 500;  ///< from one state that is kept to the next
inline constexpr std::int64_t kHashTicks = 100;  ///< from one hash to the next
inline constexpr std::uint16_t kMoveTicks = 16;  ///< from one picture of a screen to the next

/// Something the user does to the cloths.
struct ViewCommand {
  enum class Kind : std::uint8_t {
    kGrab,     ///< hand, material, radius, position (where the hand is: the cloth is not moved by gripping)
    kMove,     ///< hand, position, ticks: it goes there straight and then stays
    kRelease,  ///< hand
    kReset,    ///< to the start of the scene, all let go
    kMotion,   ///< flag: whether the scene's own hands and pins move
  };
  Kind kind = Kind::kMove;
  std::uint8_t hand = 0;
  bool flag = false;
  Vec2 material = Vec2::Zero();              ///< weft and warp coordinate [m]
  Vec3 position = Vec3::Zero();              ///< of the hand in the coordinates of the scene [m]
  double radius = 0.009;                     ///< of the patch [m], up to kMostPatchRadius
  double stiffness = GraspSpec{}.stiffness;  ///< of the hold of kGrab [N/m], up to kMostHoldStiffness
  /// How many steps the way of kMove takes, at least 1: a mouse tells its place with every picture, and a
  /// hand that jumped from one to the next would tear at the cloth.
  std::uint16_t ticks = kMoveTicks;
};
inline constexpr double kMostPatchRadius = 0.1;                                ///< [m]
inline constexpr double kLeastHoldStiffness = 1e-3, kMostHoldStiffness = 1e5;  ///< [N/m]

/// Where the hand of a device is, for the tick that comes. It grips cloth within its reach, follows every
/// tick, and lets go when it does not hold or jumps farther than its reach: after a pause, or a way back in
/// time.
struct DevicePose {
  Vec3 position = Vec3::Zero();              ///< in the coordinates of the scene [m]
  bool holds = false;                        ///< it wants to
  double reach = 0.0;                        ///< [m]
  double stiffness = GraspSpec{}.stiffness;  ///< of its hold [N/m]
};

/// What it feels after a tick.
struct DeviceTouch {
  GraspReading reading;  ///< of the cloth that is felt
  /// Counts what may have put energy into that cloth, or taken it out, besides this hand; another cloth that
  /// is felt counts, too.
  std::uint64_t disturbances = 0;
};

/// A command that was done, at the beginning of a tick; or what the hash was then; or that other cloths took
/// over.
struct ViewEvent {
  enum class Kind : std::uint8_t { kCommand, kHash, kReplaced };
  Kind kind = Kind::kCommand;
  std::int64_t tick = 0;
  ViewCommand command;
  std::uint64_t hash = 0;   ///< kHash: of all cloths
  std::uint64_t build = 0;  ///< kReplaced: as replace() gave it
  bool kept_shape = false;  ///< kReplaced: as it was asked for
};

/// What a recording says is to be done, for a session that does it again.
struct ViewScript {
  std::int64_t first_tick = 0, last_tick = 0;  ///< as the recording counts; at the last it stops
  std::vector<ViewEvent> events;               ///< commands and hashes, their ticks from first to last
  bool more = false;                           ///< another follows, which is waited for at the last tick
};

/// How far a script is.
struct ScriptView {
  bool follows = false;                ///< there is one: it runs, or waits at its last tick
  std::int64_t tick = 0;               ///< of the recording
  std::int64_t hashes = 0;             ///< compared
  std::int64_t first_difference = -1;  ///< tick of the recording; -1: none
};

/// A cloth at a moment.
struct ClothView {
  std::vector<Vec3> positions;  ///< [m] (slots)
  std::vector<double> field;    ///< of the field asked for (slots); empty: none
  std::array<GraspReading, kMostViewHands> hands;
  std::array<Vec3, kMostViewHands> targets;  ///< where the hands are [m]
  std::array<GraspReading, kMostHands> scene_hands;
  Vec3 clamp_force = Vec3::Zero();  ///< on all fixed slots [N]
  ClothProbe probe;                 ///< at the hand that gripped last and still holds
  bool probed = false;
  ClothEnergy energy;  ///< [J]
  double kinetic_energy = 0.0, max_strain = 0.0;
  std::uint64_t failed_steps = 0;  ///< steps in which a number went wrong since the start
};

/// What the screen shows.
struct ViewSnapshot {
  std::int64_t tick = 0;
  std::uint64_t build = 0;  ///< number of the setup that it belongs to
  std::vector<ClothView> cloths;
  ScriptView script;
  double time = 0.0;             ///< simulated [s]
  double step_us = 0.0;          ///< mean time that a tick of all cloths took since the last snapshot [us]
  std::int64_t first_tick = 0;   ///< seek() goes back so far
  std::int64_t newest_tick = 0;  ///< and forward so far
  bool playing = false;
};

/// Cloths that were built for a setup, ready to be handed to the session. Constant but for the simulations.
class ViewCloths {
 public:
  /// @throws Error for a setup that cannot be built. Thread class: set-up.
  explicit ViewCloths(const ViewSetup& setup);

  bool scene_moves() const noexcept { return scene_moves_; }
  std::size_t size() const noexcept { return scenes_.size(); }
  const EngineScene& scene(std::size_t cloth) const noexcept { return *scenes_[cloth]; }
  SceneRun& run(std::size_t cloth) noexcept { return *runs_[cloth]; }

 private:
  std::vector<std::unique_ptr<const EngineScene>> scenes_;
  std::vector<std::unique_ptr<SceneRun>> runs_;
  bool scene_moves_ = false;
};

/// The session. It begins paused, at tick 0, with build 0.
class ViewSession {
 public:
  /// @param cloths to begin with  @param team that shares the cloths of a tick out among its members; null:
  /// one thread; it must outlive the session. Thread class: set-up.
  explicit ViewSession(std::shared_ptr<ViewCloths> cloths, Team* team = nullptr);
  ~ViewSession();
  ViewSession(const ViewSession&) = delete;
  ViewSession& operator=(const ViewSession&) = delete;

  // ---- the screen's thread ----
  /// @return false when the queue is full (the cloth's thread does not run); the command is then forgotten.
  bool send(const ViewCommand& command) noexcept;
  /// Other cloths from the next round on. @param cloths fresh ones: the session steps them on its own thread
  /// from here on, and only scene() of them may be read elsewhere. @param keep_shape takes positions,
  /// velocities, holds and the memory of friction over where scene, lattice and pins are the same; a cloth
  /// that was not there before gets the shape of the first. @return the build number its snapshots and the
  /// event will have.
  /// @param script to follow from there on: its commands are done at their ticks, and its hashes compared,
  /// until the session pauses at its last tick. A command of the user's, or a replace() without a script,
  /// ends it; the hand of a device does nothing meanwhile.
  std::uint64_t replace(std::shared_ptr<ViewCloths> cloths, bool keep_shape,
                        std::shared_ptr<const ViewScript> script = nullptr);
  /// The last number that replace() gave; 0 before the first. What it belongs to may still be on its way.
  std::uint64_t newest_build() const noexcept;
  /// Which cloth the hand of a device feels and takes hold of, and whose energy stored_energy() tells; where
  /// there are fewer, the last.
  void feel(std::size_t cloth) noexcept;
  /// Which ClothField the snapshots are to carry; none: -1.
  void show_field(int field) noexcept;
  void play(bool plays) noexcept;
  /// How many ticks to do while it is paused. Within what was done before, they are done as they were.
  void single_steps(int ticks) noexcept;
  /// Goes back (or forward to what was done before) to a tick, and pauses there; the commands after it are
  /// forgotten once the user does something or plays on. Clamped to [first_tick, newest_tick].
  void seek(std::int64_t tick) noexcept;
  /// The same, so many ticks back from where earlier orders lead: each of several counts.
  void step_back(int ticks) noexcept;
  /// Takes the newest snapshot. @return whether there is a new one.
  bool fetch() noexcept;
  /// Valid until the next fetch(), from the beginning on.
  const ViewSnapshot& snapshot() const noexcept;
  /// What was done since the last call, in order. A seek backwards that is followed by something else takes
  /// events back: `rewound_to` is then the tick from which on all events of earlier calls are void, else -1.
  /// A hash comes every kHashTicks. To be called with every picture, or events are lost (lost_events()).
  std::vector<ViewEvent> take_events(std::int64_t& rewound_to);
  /// How many events found no room since the beginning: a recording that runs then is worth nothing.
  std::uint64_t lost_events() const noexcept;

  // ---- the cloth's thread ----
  /// One round: commands, and a tick if it plays or steps are asked for.
  /// @param wall_us clock of the caller [us]; it decides only when snapshots are made
  /// @return whether a new tick was done. Thread class: real-time but for the first snapshots after
  /// replace().
  /// @param device hand of a device; null: there is none. What it does is done as commands of the tick, so
  /// that they are recorded, and repeated without it.
  bool tick(double wall_us, const DevicePose* device = nullptr);
  /// Thread class: real-time.
  DeviceTouch device_touch() const noexcept;
  /// As ClothSimulation::stored_energy(), of the cloth that is felt; costs as much as a step. Thread class:
  /// real-time.
  double stored_energy() const;
  std::int64_t ticks() const noexcept;  ///< Thread class: any.
  /// Of all cloths as they are.
  std::uint64_t state_hash() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fuai
