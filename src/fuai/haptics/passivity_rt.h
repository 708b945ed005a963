// Passivity observer and controller: what the force path gives to the hand it must have got.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Energy"; Hannaford and Ryu 2002 (observer and controller), Ryu,
// Kwon and Hannaford 2004 (energy known of the environment).
//
//   W   work of the hand on the port, sum of -F[k-1].(x[k] - x[k-1]), F as it was given
//   L   of it, the leak: what it differs by from the trapezoid rule on the model's force, which is what a
//       port without sampling would exchange
//   A   audited with every model that tells S, the energy stored in the cloth: A += dW - dS between the
//       moments of two such models; at most `reserve`
//   E   = A + (L - L of the last audit's moment)
//
//   While E < -tolerance the controller brakes: F -= alpha v, alpha = -(E + tolerance) / (payback v^2), at
//   most 0.45 m / dt.
#pragma once

#include "fuai/haptics/local_model_rt.h"

namespace fuai {

/// How strict, how fast.
struct PassivityOptions {
  bool control = true;      ///< brake; else only observe
  double reserve = 0.5e-3;  ///< most energy that the cloth's losses may save up for later [J]
  double tolerance = 1e-4;  ///< debt that is not called in [J]: a tenth of what a hand may be given, and far
                            ///< above what encoder steps make of nothing
  double payback = 0.005;   ///< time in which a debt is paid [s]; one tick would turn encoder steps to kicks
  double mass = 0.045;      ///< of the device [kg]: bounds the brake, 0.45 m / dt is half of a dead stop
};

/// Keeps the books of one port.
class Passivity {
 public:
  explicit Passivity(const PassivityOptions& options = {}) noexcept : options_(options) {}

  /// No debts, no savings, no place before; the ledger goes on. Thread class: real-time.
  void restart() noexcept;
  /// The device has moved. @param position [m]. Thread class: real-time.
  void move(const Vec3& position) noexcept;
  /// A new model, as the device feels it. @param gain share of it that is given, 0 to 1. Thread class:
  /// real-time.
  void audit(const LocalModel& model, double gain) noexcept;
  /// What the model says at the place of the last move(), before anything changes it [N]. Thread class:
  /// real-time.
  void expect(const Vec3& force) noexcept;
  /// The brake for a force that is about to be given [N]. @param velocity [m/s] @param dt [s], > 0
  Vec3 brake(const Vec3& velocity, double dt) const noexcept;
  /// What is given until the next move() [N]. Thread class: real-time.
  void give(const Vec3& force) noexcept { given_ = force; }

  /// E [J]. Thread class: real-time.
  double energy() const noexcept { return audited_ + (ledger_.leak - audited_leak_); }
  const PortLedger& ledger() const noexcept { return ledger_; }

 private:
  PassivityOptions options_;
  PortLedger ledger_;
  bool started_ = false, has_audit_ = false;
  Vec3 position_ = Vec3::Zero(), way_ = Vec3::Zero();
  Vec3 given_ = Vec3::Zero(), expected_ = Vec3::Zero();
  double audited_ = 0.0, audited_leak_ = 0.0, audited_work_ = 0.0, audited_stored_ = 0.0;
};

}  // namespace fuai
