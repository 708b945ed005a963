// Runs felt scenes.
// SPDX-License-Identifier: Apache-2.0
#include "felt_run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/device/registry.h"
#include "fuai/haptics/hand_rules.h"
#include "fuai/runtime/interrupt.h"

namespace fuai_app {

using namespace fuai;

namespace {

/// The way of a scene's hand, from where it begins [m] (ticks), after a rest.
std::vector<Vec3> hand_way(const EngineScene& scene, std::size_t hand, std::int64_t ticks) {
  std::vector<Vec3> way;
  const Vec3 start = scene.motion->hand(hand, 0.0).position;
  for (std::int64_t i = 0; i <= ticks; ++i) {
    const double time = std::max(0.0, static_cast<double>(i) * kTick - rest_time());
    way.push_back(scene.motion->hand(hand, time).position - start);
  }
  return way;
}

/// Centre of a way, and its fitting_scale().
struct Fit {
  Vec3 middle = Vec3::Zero();
  double scale = 1.0;
};
Fit fit_way(const std::vector<Vec3>& way, const DeviceInfo& info) {
  Vec3 low = way.front(), high = way.front();
  for (const Vec3& place : way) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return {0.5 * (low + high), fitting_scale(high - low, info)};
}

/// Devices, hands and paths of a run.
struct FeltHands {
  std::vector<std::unique_ptr<Device>> devices;
  std::vector<std::unique_ptr<ForcePath>> paths;
  std::vector<SessionHand> views;
};

FeltHands make_hands(const FeltPlan& plan, const ClothHand& cloth) {
  FeltHands hands;
  for (std::size_t i = 0; i < cloth.hands(); ++i) {
    if (is_simulated(plan.device)) {
      SimulatedDeviceSpec spec = simulated_spec(plan.device);
      spec.info = plan.setup.device;
      hands.devices.push_back(std::make_unique<SimulatedDevice>(spec, find_hand_model(plan.hand),
                                                                make_path_motion(plan.ways[i], kTick)));
    } else {
      hands.devices.push_back(open_device(plan.device));
    }
    hands.paths.push_back(std::make_unique<ForcePath>(make_path_options(plan.setup, cloth, i)));
    hands.views.push_back({hands.devices.back().get(), hands.paths.back().get()});
  }
  return hands;
}

class Holds final : public HoldRule {
 public:
  Holds(HoldBy by, const EngineScene& scene) : by_(by), scene_(scene) {}
  bool holds(std::size_t hand, double time, const DeviceSample& last) noexcept override {
    switch (by_) {
      case HoldBy::kScene:
        return scene_.motion->hand(hand, std::max(0.0, time - rest_time())).holds;
      case HoldBy::kAlways:
        return true;
      case HoldBy::kButton:
        return wants_to_hold(last);
    }
    return false;
  }

 private:
  HoldBy by_;
  const EngineScene& scene_;
};

/// Keeps ticks in room that was made before, and passes everything on.
class Keeper final : public SessionListener {
 public:
  Keeper(std::size_t room, SessionListener* next) : next_(next) { records.reserve(room); }
  void on_tick(const TickRecord& record) noexcept override {
    if (records.size() < records.capacity()) records.push_back(record);
    if (next_ != nullptr) next_->on_tick(record);
  }
  void on_step(const ClothStepRecord& record) noexcept override {
    if (next_ != nullptr) next_->on_step(record);
  }
  std::vector<TickRecord> records;

 private:
  SessionListener* next_;
};

void run_virtual(const Console& console, const EngineScene& scene, const FeltPlan& plan,
                 const FeltHands& hands, ClothHand& cloth, Keeper& keeper, FeltResult& result) {
  const double period = plan.setup.cloth_period;
  VirtualSession session(hands.views, cloth, {period, period, 0, &keeper});
  Holds holds(plan.hold, scene);
  const Progress progress = console.progress();
  const DeviceSample last;  // a simulated device has no buttons
  for (std::int64_t i = 0; i < plan.ticks; ++i) {
    for (std::size_t hand = 0; hand < hands.paths.size(); ++hand)
      hands.paths[hand]->hold(holds.holds(hand, static_cast<double>(i + 1) * kTick, last));
    session.tick(kTick);
    if (progress && i % 16 == 0)
      progress("hand in " + scene.name, static_cast<double>(i) / static_cast<double>(plan.ticks));
  }
  result.cloth_steps = session.cloth_steps();
}

void run_real(const Console& console, const EngineScene& scene, const FeltPlan& plan, const FeltHands& hands,
              ClothHand& cloth, Keeper& keeper, FeltResult& result) {
  RealtimeOptions options;
  options.tick = kTick;
  options.cloth_period = std::max(kTick, plan.setup.cloth_period);
  options.ticks = plan.ticks;
  Holds holds(plan.hold, scene);
  RealtimeSession session(hands.views, cloth, options, &holds, &keeper);
  const InterruptFlag interrupt;
  MonotonicClock force_clock, cloth_clock;
  const Progress progress = console.progress();
  result.realtime = session.run(force_clock, cloth_clock, interrupt.flag(), [&](std::int64_t ticks) {
    if (progress)
      progress("hand in " + scene.name, static_cast<double>(ticks) / static_cast<double>(plan.ticks));
  });
  result.stopped = result.realtime->ticks < plan.ticks;
  result.cloth_steps = result.realtime->cloth_steps;
}

}  // namespace

double rest_time() { return SafetyOptions{}.ramp; }

bool is_simulated(const std::string& device) {
  return find_device_driver(device.substr(0, device.find(':'))).name == simulated_driver().name;
}

const SimulatedDeviceSpec& simulated_spec(const std::string& device) {
  const std::size_t colon = device.find(':');
  if (!is_simulated(device)) {
    throw Error(ErrorKind::kUsage, "virtual time is for the simulated device, not '" + device + "'", {},
                "take --device simulated");
  }
  if (colon == std::string::npos) return device_presets().front().spec;
  return find_device_preset(device.substr(colon + 1));
}

void fit_plan(FeltPlan& plan, const EngineScene& scene) {
  FeltSetup& setup = plan.setup;
  std::vector<Fit> fits;
  for (std::size_t hand = 0; hand < scene.hands.size(); ++hand) {
    plan.ways.push_back(hand_way(scene, hand, plan.ticks));
    fits.push_back(fit_way(plan.ways.back(), setup.device));
    setup.scale = std::max(setup.scale, fits.back().scale);
  }
  for (std::size_t hand = 0; hand < scene.hands.size(); ++hand) {
    for (Vec3& place : plan.ways[hand]) place = (place - fits[hand].middle) / setup.scale;
    // A hand of flesh begins wherever it is: the middle of its device is where the scene's hand begins.
    setup.device_centres.push_back(
        is_simulated(plan.device) ? plan.ways[hand].front()
                                  : Vec3(0.5 * (setup.device.workspace_low + setup.device.workspace_high)));
  }
  setup.hold_stiffness = most_hold_stiffness(setup.device, setup.scale, setup.force_gain);
}

FeltResult run_felt(const Console& console, const EngineScene& scene, const FeltPlan& plan,
                    SessionListener* listener) {
  const std::unique_ptr<ClothHand> cloth = make_cloth(scene, plan.setup);
  const FeltHands hands = make_hands(plan, *cloth);
  Keeper keeper(static_cast<std::size_t>(plan.ticks) * hands.paths.size(), listener);
  FeltResult result;
  (plan.virtual_time ? run_virtual : run_real)(console, scene, plan, hands, *cloth, keeper, result);
  result.hands = hands.paths.size();
  result.counters = hands.paths.front()->counters();
  result.map = hands.paths.front()->map();
  result.failed_steps = cloth->failed_steps();
  result.state_hash = cloth->simulation().read().state_hash;
  result.records = std::move(keeper.records);
  // A hand that takes the cloth where it is has no reference: that one grips the scene's patch.
  if (!plan.reference || result.hands > 1 || plan.setup.reach > 0.0) return result;
  const std::vector<Vec3> reference = converged_forces(
      {&scene.model, &scene.material, scene.options.implicit, &scene.start, make_grasp(scene, plan.setup, 0)},
      result.records, console.progress());
  result.error = compare_forces(result.records, reference, result.map);
  return result;
}

}  // namespace fuai_app
