// What a session tells of itself: every tick of every hand, and every step of the cloth. Enough to do it all
// again, bit for bit.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Recording".
#pragma once

#include <cstdint>

#include "fuai/device/device.h"
#include "fuai/haptics/force_path_rt.h"

namespace fuai {

/// Most hands of a session.
inline constexpr std::size_t kMostSessionHands = 4;

/// A tick of one hand.
struct TickRecord {
  std::uint64_t number = 0;     ///< of the tick, from 0; all hands of a session tick together
  std::uint32_t hand = 0;       ///< from 0
  double time = 0.0, dt = 0.0;  ///< [s]
  DeviceSample sample;          ///< as read
  Vec3 tool = Vec3::Zero();     ///< [m]
  double speed = 0.0;           ///< of the device, filtered [m/s]
  bool holds = true;            ///< the hand wants to hold cloth
  std::uint64_t arrived = 0;    ///< newest model that the path had fetched, used or not
  ForceTick tick;
};

/// A step of the cloth.
struct ClothStepRecord {
  std::uint64_t number = 0;  ///< from 1, that of its models
  std::uint64_t tick = 0;    ///< whose poses it answers
  double dt = 0.0;           ///< [s]
  double next = 0.0;         ///< how long its models were to serve [s]
  std::uint64_t hash = 0;    ///< of the state after it; 0: not taken
};

/// A state's hash is taken every so many steps: at 1 kHz four times a second, for a few hundred microseconds.
inline constexpr std::uint64_t kCheckpointSteps = 250;

/// Hears records. Each function is called by one thread, not both by the same one.
class SessionListener {
 public:
  SessionListener() = default;
  SessionListener(const SessionListener&) = delete;
  SessionListener& operator=(const SessionListener&) = delete;
  virtual ~SessionListener() = default;
  /// By the thread of the force loop. Thread class: real-time.
  virtual void on_tick(const TickRecord& record) noexcept = 0;
  /// By the thread of the cloth. Thread class: real-time.
  virtual void on_step(const ClothStepRecord& record) noexcept = 0;
};

}  // namespace fuai
