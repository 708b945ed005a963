// Times one haptic tick without the cloth, and the parts that the force loop shares with nothing else.
// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>

#include "fuai/core/mailbox_rt.h"
#include "fuai/device/device_simulated.h"
#include "fuai/haptics/environment.h"
#include "fuai/haptics/force_path_rt.h"

namespace {

using namespace fuai;

constexpr double kTick = 1e-3;

/// follow() and render() on a place that moves; a new model every `every` ticks.
void haptic_tick(benchmark::State& bench) {
  const auto every = static_cast<std::uint64_t>(bench.range(0));
  ForcePath path(make_force_path_options(find_device_preset("premium").info));
  SpringWall wall(300.0, 0.0, Vec3::Zero(), SpringWall::Answer::kTangent);
  DeviceSample sample;
  std::uint64_t tick = 0;
  LocalModel model;
  for (auto _ : bench) {
    sample.position.x() = 1e-5 * static_cast<double>(tick % 1000);
    const ToolPose pose = path.follow(sample, kTick);
    if (tick % every == 0) path.models().put(wall.update(pose, kTick, kTick));
    ForceTick felt = path.render();
    benchmark::DoNotOptimize(felt);
    ++tick;
  }
}
BENCHMARK(haptic_tick)->Arg(1)->Arg(16);

/// A tick of the computed device and hand: 20 substeps.
void device_tick(benchmark::State& bench) {
  SimulatedDevice device(find_device_preset("premium"), find_hand_model("arm"),
                         make_still_motion(Vec3::Zero()));
  for (auto _ : bench) {
    DeviceSample sample = device.read();
    benchmark::DoNotOptimize(sample);
    device.write({Vec3(0.1, 0.0, 0.0)});
    device.advance(kTick);
  }
}
BENCHMARK(device_tick);

void mailbox_put_and_fetch(benchmark::State& bench) {
  Mailbox<LocalModel> box;
  LocalModel model;
  for (auto _ : bench) {
    ++model.number;
    box.put(model);
    benchmark::DoNotOptimize(box.fetch());
  }
}
BENCHMARK(mailbox_put_and_fetch);

}  // namespace
