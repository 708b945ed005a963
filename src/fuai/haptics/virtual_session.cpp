// The force path in virtual time.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/virtual_session.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/error.h"

namespace fuai {

VirtualSession::VirtualSession(SimulatedDevice& device, ForcePath& path, HapticEnvironment& environment,
                               const VirtualSessionOptions& options)
    : device_(device), path_(path), environment_(environment), options_(options) {
  if (!(options.cloth_period >= 0.0) || !(options.latency >= 0.0))
    throw Error(ErrorKind::kUsage, "a session's period and latency must not be negative");
  if (options.latency > 0.0 && options.latency > 4.0 * options.cloth_period)
    throw Error(ErrorKind::kUsage, "a session's latency must be at most four periods of the cloth");
  records_.reserve(options.records);
}

void VirtualSession::step_cloth(const ToolPose& pose, double dt) noexcept {
  if (stalled_) {
    cloth_time_ = pose.time;  // what was missed is not made up for
    return;
  }
  const double period = options_.cloth_period;
  // Half a tick early is on time: ticks and periods do not fit.
  if (pose.time - cloth_time_ < period - 0.5 * dt) return;
  const double step = pose.time - cloth_time_;
  cloth_time_ = pose.time;
  ++cloth_steps_;
  const LocalModel model = environment_.update(pose, step, std::max(period, dt));
  sent_[(first_ + count_) % sent_.size()] = {pose.time + options_.latency, model};
  count_ = std::min(count_ + 1, sent_.size());
}

void VirtualSession::deliver(double now) noexcept {
  while (!stalled_ && count_ > 0 && sent_[first_].arrives <= now + 1e-9) {
    path_.models().put(sent_[first_].model);
    first_ = (first_ + 1) % sent_.size();
    --count_;
  }
}

const ForceTick& VirtualSession::tick(double dt) noexcept {
  const DeviceSample sample = device_.read();
  const ToolPose pose = path_.follow(sample, dt);
  step_cloth(pose, dt);
  deliver(pose.time);
  last_ = path_.render();
  device_.write({last_.force});
  device_.advance(dt);
  if (records_.size() < records_.capacity())
    records_.push_back({pose.time, dt, sample.position, pose.position,
                        pose.velocity.norm() / path_.map().scale, pose.holds, last_});
  return last_;
}

SessionFigures read_figures(const std::vector<TickRecord>& records, double still) {
  SessionFigures figures;
  if (records.empty()) return figures;
  std::vector<double> ages;
  double square = 0.0, moving = 0.0, changed = 0.0;
  Vec3 last = records.front().tick.force;
  for (const TickRecord& record : records) {
    const Vec3& force = record.tick.force;
    square += force.squaredNorm();
    figures.force_peak = std::max(figures.force_peak, force.norm());
    figures.largest_step = std::max(figures.largest_step, (force - last).norm());
    figures.energy_min = std::min(figures.energy_min, record.tick.energy);
    if (record.speed > still && record.tick.gain > 0.0) {
      moving += 1.0;
      changed += force != last ? 1.0 : 0.0;
    }
    if (record.tick.model > 0) ages.push_back(record.tick.model_age);
    last = force;
  }
  figures.force_rms = std::sqrt(square / static_cast<double>(records.size()));
  if (moving > 0.0) figures.changed_share = changed / moving;
  if (ages.empty()) return figures;
  std::sort(ages.begin(), ages.end());
  figures.model_age = {ages[ages.size() / 2], ages[ages.size() * 99 / 100], ages.back()};
  return figures;
}

}  // namespace fuai
