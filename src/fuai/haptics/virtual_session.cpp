// The force path in virtual time.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/virtual_session.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/error.h"

namespace fuai {

VirtualSession::VirtualSession(std::span<const SessionHand> hands, HapticEnvironment& environment,
                               const VirtualSessionOptions& options)
    : environment_(environment), options_(options) {
  if (hands.size() != environment.hands() || hands.empty() || hands.size() > kMostSessionHands)
    throw Error(ErrorKind::kUsage, "a session needs a device for each hand that holds the cloth");
  if (!(options.cloth_period >= 0.0) || !(options.latency >= 0.0))
    throw Error(ErrorKind::kUsage, "a session's period and latency must not be negative");
  if (options.latency > 0.0 && options.latency > 4.0 * options.cloth_period)
    throw Error(ErrorKind::kUsage, "a session's latency must be at most four periods of the cloth");
  for (std::size_t i = 0; i < hands.size(); ++i)
    loops_.emplace_back(*hands[i].device, *hands[i].path, static_cast<std::uint32_t>(i));
  records_.reserve(options.records * hands.size());
}

VirtualSession::VirtualSession(Device& device, ForcePath& path, HapticEnvironment& environment,
                               const VirtualSessionOptions& options)
    : VirtualSession(std::array{SessionHand{&device, &path}}, environment, options) {}

void VirtualSession::step_cloth(double now, double dt) noexcept {
  if (stalled_) {
    cloth_time_ = now;  // what was missed is not made up for
    return;
  }
  const double period = options_.cloth_period;
  // Half a tick early is on time: ticks and periods do not fit.
  if (now - cloth_time_ < period - 0.5 * dt) return;
  ClothStepRecord step;
  step.number = ++cloth_steps_;
  step.tick = loops_.front().record().number;
  step.dt = now - cloth_time_;
  step.next = std::max(period, dt);
  cloth_time_ = now;
  Sent& sent = sent_[(first_ + count_) % sent_.size()];
  sent.arrives = now + options_.latency;
  environment_.update_all({poses_.data(), loops_.size()}, step.dt, step.next,
                          {sent.models.data(), loops_.size()});
  count_ = std::min(count_ + 1, sent_.size());
  if (options_.listener == nullptr) return;
  if (step.number % kCheckpointSteps == 0) step.hash = environment_.state_hash();
  options_.listener->on_step(step);
}

void VirtualSession::deliver(double now) noexcept {
  while (!stalled_ && count_ > 0 && sent_[first_].arrives <= now + 1e-9) {
    for (std::size_t i = 0; i < loops_.size(); ++i) loops_[i].path().models().put(sent_[first_].models[i]);
    first_ = (first_ + 1) % sent_.size();
    --count_;
  }
}

const ForceTick& VirtualSession::tick(double dt) noexcept {
  for (std::size_t i = 0; i < loops_.size(); ++i) poses_[i] = loops_[i].read(dt);
  const double now = poses_.front().time;
  step_cloth(now, dt);
  deliver(now);
  for (HapticLoop& loop : loops_) {
    const TickRecord& record = loop.write();
    loop.device().advance(dt);
    if (records_.size() < records_.capacity()) records_.push_back(record);
    if (options_.listener != nullptr) options_.listener->on_tick(record);
  }
  return last();
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
