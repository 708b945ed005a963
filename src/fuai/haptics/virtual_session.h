// Devices, force paths and cloth in virtual time: the same path as with threads, ticked by one caller.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Virtual time".
//
//   A tick: the devices are read; if the cloth is due it steps to the poses and its models are sent; models
//   whose latency is over arrive; the forces are rendered and written; time passes in the devices. Everything
//   depends on the devices' motion and the dt of the ticks only.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "fuai/haptics/environment.h"
#include "fuai/haptics/haptic_loop_rt.h"

namespace fuai {

/// When the cloth steps.
struct VirtualSessionOptions {
  double cloth_period = 0.0;            ///< [s]; 0: with every tick, and its force is there at once
  double latency = 0.0;                 ///< from a pose to its model's arrival [s]
  std::size_t records = 0;              ///< ticks of a hand to keep room for; 0: no records
  SessionListener* listener = nullptr;  ///< not owned; hears every tick and step
};

/// Who holds what.
struct SessionHand {
  Device* device = nullptr;   ///< not owned
  ForcePath* path = nullptr;  ///< not owned
};

/// The session. All of it must outlive it.
class VirtualSession {
 public:
  /// @param hands as many as the environment answers
  /// @throws Error (kUsage) for options out of range. Thread class: set-up.
  VirtualSession(std::span<const SessionHand> hands, HapticEnvironment& environment,
                 const VirtualSessionOptions& options = {});
  /// The same with one hand.
  VirtualSession(Device& device, ForcePath& path, HapticEnvironment& environment,
                 const VirtualSessionOptions& options = {});

  /// One tick of dt. @return what it was for the first hand. Thread class: real-time while there is room for
  /// records.
  const ForceTick& tick(double dt) noexcept;
  /// While it is stalled the cloth does not step and no model arrives. Thread class: real-time.
  void stall(bool stalled) noexcept { stalled_ = stalled; }

  const ForceTick& last(std::size_t hand = 0) const noexcept { return loops_[hand].record().tick; }
  /// By tick, and within a tick by hand.
  const std::vector<TickRecord>& records() const noexcept { return records_; }
  std::uint64_t cloth_steps() const noexcept { return cloth_steps_; }

 private:
  struct Sent {
    double arrives = 0.0;
    std::array<LocalModel, kMostSessionHands> models;
  };
  void step_cloth(double now, double dt) noexcept;
  void deliver(double now) noexcept;

  std::vector<HapticLoop> loops_;
  HapticEnvironment& environment_;
  VirtualSessionOptions options_;
  std::array<ToolPose, kMostSessionHands> poses_;
  std::array<Sent, 8> sent_;  // a ring
  std::size_t first_ = 0, count_ = 0;
  double cloth_time_ = 0.0;
  bool stalled_ = false;
  std::uint64_t cloth_steps_ = 0;
  std::vector<TickRecord> records_;
};

/// Summary of records.
struct SessionFigures {
  double force_rms = 0.0, force_peak = 0.0;  ///< [N]
  double largest_step = 0.0;                 ///< of the force from tick to tick [N]
  double energy_min = 0.0;                   ///< of the passivity observer [J]
  double changed_share = 1.0;                ///< of the ticks in which the device moves that change the force
  std::array<double, 3> model_age{};         ///< median, 99 %, largest [s]
};
/// @param still speed below which the device does not move [m/s]. Thread class: set-up.
SessionFigures read_figures(const std::vector<TickRecord>& records, double still = 0.005);

}  // namespace fuai
