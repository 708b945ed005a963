// Builds felt scenes.
// SPDX-License-Identifier: Apache-2.0
#include "felt_setup.h"

#include <algorithm>

#include "fuai/core/error.h"
#include "fuai/sim/felt_options.h"

namespace fuai_app {

using namespace fuai;

namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

/// Every number of the setup under its name, hands' places apart. @param visit (name, number)
template <class Setup, class Visit>
void visit_numbers(Setup& setup, const Visit& visit) {
  auto& d = setup.device;
  visit("force_gain", setup.force_gain);
  visit("scale", setup.scale);
  visit("cloth_period", setup.cloth_period);
  visit("hold_stiffness", setup.hold_stiffness);
  visit("reach", setup.reach);
  for (int i = 0; i < 3; ++i) {
    visit(std::string("workspace_low_") + kAxes[i], d.workspace_low[i]);
    visit(std::string("workspace_high_") + kAxes[i], d.workspace_high[i]);
  }
  visit("peak_force", d.peak_force);
  visit("continuous_force", d.continuous_force);
  visit("thermal_time", d.thermal_time);
  visit("stable_stiffness", d.stable_stiffness);
  visit("stable_damping", d.stable_damping);
  visit("resolution", d.resolution);
  visit("rate", d.rate);
  visit("mass", d.mass);
  visit("command_timeout", d.command_timeout);
}

std::string centre_key(std::size_t hand, int axis) {
  return "hand_" + std::to_string(hand) + "_centre_" + kAxes[axis];
}

}  // namespace

GraspSpec make_grasp(const EngineScene& scene, const FeltSetup& setup, std::size_t hand) {
  GraspSpec grasp = scene.hands[hand];
  grasp.stiffness = std::min(grasp.stiffness, setup.hold_stiffness);
  return grasp;
}

std::unique_ptr<ClothHand> make_cloth(const EngineScene& scene, const FeltSetup& setup) {
  ClothHandOptions answer;
  answer.tangent = setup.cloth_period > 0.0;
  answer.reach = setup.reach;
  std::vector<GraspSpec> grasps;
  for (std::size_t i = 0; i < scene.hands.size(); ++i) grasps.push_back(make_grasp(scene, setup, i));
  const ClothSolverOptions solver{SolverKind::kImplicit, make_felt_options(scene.options.implicit), 0};
  return std::make_unique<ClothHand>(scene.model, scene.material, solver, scene.start, grasps, answer);
}

ForcePathOptions make_path_options(const FeltSetup& setup, const ClothHand& cloth, std::size_t hand) {
  ForcePathOptions options = make_force_path_options(setup.device);
  options.passivity.control = setup.control;
  options.map.scale = setup.scale;
  options.map.force_gain = setup.force_gain;
  options.map.device_centre = setup.device_centres[hand];
  options.map.cloth_centre = cloth.patch(hand);
  return options;
}

SessionLogInfo felt_info(const FeltSetup& setup, const Fabric& fabric) {
  SessionLogInfo info = begin_info("haptics", setup.scene, fabric);
  info.words.emplace_back("driver", setup.device.driver);
  info.words.emplace_back("device", setup.device.model);
  visit_numbers(setup, [&](const std::string& key, double value) { info.numbers.emplace_back(key, value); });
  info.numbers.emplace_back("control", setup.control ? 1.0 : 0.0);
  info.numbers.emplace_back("hands", static_cast<double>(setup.device_centres.size()));
  for (std::size_t hand = 0; hand < setup.device_centres.size(); ++hand)
    for (int i = 0; i < 3; ++i) info.numbers.emplace_back(centre_key(hand, i), setup.device_centres[hand][i]);
  return info;
}

FeltSetup felt_setup_of(const SessionLogInfo& info) {
  FeltSetup setup;
  setup.scene = scene_setup_of(info);
  setup.device.driver = info.word("driver");
  setup.device.model = info.word("device");
  visit_numbers(setup, [&](const std::string& key, double& value) { value = info.number(key); });
  setup.control = info.number("control") != 0.0;
  const double hands = info.number("hands");
  if (!(hands >= 1.0 && hands <= static_cast<double>(kMostSessionHands))) {
    throw Error(ErrorKind::kBadInput, "the recording's 'hands' is out of range", {},
                "record the session again");
  }
  setup.device_centres.resize(static_cast<std::size_t>(hands));
  for (std::size_t hand = 0; hand < setup.device_centres.size(); ++hand)
    for (int i = 0; i < 3; ++i) setup.device_centres[hand][i] = info.number(centre_key(hand, i));
  return setup;
}

}  // namespace fuai_app
