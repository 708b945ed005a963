// The books of a port.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/passivity_rt.h"

#include <algorithm>
#include <cmath>

namespace fuai {

void Passivity::restart() noexcept {
  const PortLedger kept = ledger_;  // models on their way still refer to it
  *this = Passivity(options_);
  ledger_ = kept;
  audited_leak_ = kept.leak;
}

void Passivity::move(const Vec3& position) noexcept {
  way_ = started_ ? Vec3(position - position_) : Vec3(Vec3::Zero());
  position_ = position;
  started_ = true;
  const double work = -given_.dot(way_);
  ledger_.work += work;
  // The first half of the trapezoid; expect() adds the other.
  ledger_.leak += work + 0.5 * expected_.dot(way_);
}

void Passivity::expect(const Vec3& force) noexcept {
  ledger_.leak += 0.5 * force.dot(way_);
  way_ = Vec3::Zero();
  expected_ = force;
}

void Passivity::audit(const LocalModel& model, double gain) noexcept {
  // A model that does not tell what is stored leaves the last audit standing; the leak goes on from there.
  if (has_audit_ && !std::isfinite(model.stored_energy)) return;
  if (has_audit_) {
    const double stored = model.stored_energy - audited_stored_;
    audited_ += model.ledger.work - audited_work_ - gain * stored;
    audited_ = std::min(audited_, options_.reserve);
  }
  audited_work_ = model.ledger.work;
  audited_leak_ = model.ledger.leak;
  audited_stored_ = model.stored_energy;
  has_audit_ = std::isfinite(model.stored_energy);
}

Vec3 Passivity::brake(const Vec3& velocity, double dt) const noexcept {
  const double debt = -energy() - options_.tolerance, square = velocity.squaredNorm();
  if (!options_.control || !(debt > 0.0) || !(square > 0.0)) return Vec3::Zero();
  const double most = 0.45 * options_.mass / dt;
  return -std::min(most, debt / (options_.payback * square)) * velocity;
}

}  // namespace fuai
