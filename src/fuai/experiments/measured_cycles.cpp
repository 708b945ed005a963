// Compares laws with measured nested cycles.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/measured_cycles.h"

#include "fuai/experiments/fabric_plot.h"
#include "fuai/fabric/laws.h"
#include "fuai/io/fabric_library.h"

namespace fuai {

std::vector<MeasuredCycles> compare_all_measured_cycles() {
  std::vector<MeasuredCycles> all;
  for (const std::string& id : bundled_fabric_ids()) {
    const Fabric fabric = load_fabric(id);
    const FabricLaws laws = make_fabric_laws(fabric);
    const auto add = [&](const std::string& name, const PlayLaw& law,
                         const std::optional<KnownCurve>& known) {
      if (!known || known->curve.branches.size() < 4) return;
      all.push_back({id, fabric.name, name, known->curve, compare_cycles(law, known->curve)});
    };
    for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
      const auto i = static_cast<std::size_t>(direction);
      add(std::string("tensile.") + to_string(direction), laws.tensile[i], fabric.tensile[i].curve);
    }
    std::optional<KnownCurve> shear = fabric.shear.curve;
    if (shear) shear->curve = to_shear_stress(shear->curve, laws.shear_test);
    add("shear", laws.shear, shear);
  }
  return all;
}

Plot measured_cycles_plot(const MeasuredCycles& cycles) {
  Plot plot = curve_and_prediction_plot(cycles.curve, cycles.comparison.predicted);
  plot.title = cycles.fabric_name + ", " + cycles.law;
  return plot;
}

}  // namespace fuai
