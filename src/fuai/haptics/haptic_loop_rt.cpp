// The two halves of a tick.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/haptics/haptic_loop_rt.h"

namespace fuai {

const ToolPose& HapticLoop::read(double dt) noexcept {
  record_.number = ticks_++;
  record_.dt = dt;
  record_.sample = device_->read();
  pose_ = path_->follow(record_.sample, dt);
  return pose_;
}

const TickRecord& HapticLoop::write() noexcept {
  record_.tick = path_->render();
  device_->write({record_.tick.force});
  record_.time = pose_.time;
  record_.tool = pose_.position;
  record_.speed = pose_.velocity.norm() / path_->map().scale;
  record_.holds = pose_.holds;
  record_.arrived = path_->arrived();
  return record_;
}

}  // namespace fuai
