// Lists the numbers of a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/fabric_numbers.h"

namespace fuai {

std::vector<FabricNumber> fabric_numbers(const Fabric& fabric) {
  std::vector<FabricNumber> list{{"weight", Kes::kW, &fabric.areal_mass},
                                 {"thickness", Kes::kT, &fabric.thickness}};
  for (Direction direction : {Direction::kWarp, Direction::kWeft, Direction::kBias}) {
    const BendingMeasurement& b = fabric.bending[static_cast<std::size_t>(direction)];
    const std::string section = std::string("bending.") + to_string(direction);
    list.push_back({section, Kes::kB, &b.B});
    list.push_back({section, Kes::k2HB, &b.hysteresis_2HB});
  }
  list.push_back({"shear", Kes::kG, &fabric.shear.G});
  list.push_back({"shear", Kes::k2HG, &fabric.shear.hysteresis_2HG});
  list.push_back({"shear", Kes::k2HG5, &fabric.shear.hysteresis_2HG5});
  for (Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const TensileMeasurement& t = fabric.tensile[static_cast<std::size_t>(direction)];
    const std::string section = std::string("tensile.") + to_string(direction);
    list.push_back({section, Kes::kLT, &t.LT});
    list.push_back({section, Kes::kWT, &t.WT});
    list.push_back({section, Kes::kRT, &t.RT});
    list.push_back({section, Kes::kEMT, &t.EMT});
  }
  list.push_back({"compression", Kes::kLC, &fabric.compression.LC});
  list.push_back({"compression", Kes::kWC, &fabric.compression.WC});
  list.push_back({"compression", Kes::kRC, &fabric.compression.RC});
  list.push_back({"surface", Kes::kMIU, &fabric.surface.MIU});
  list.push_back({"surface", Kes::kMMD, &fabric.surface.MMD});
  list.push_back({"surface", Kes::kSMD, &fabric.surface.SMD});
  list.push_back({"drape", Kes::kDrapeCoefficient, &fabric.drape.drape_coefficient});
  return list;
}

}  // namespace fuai
