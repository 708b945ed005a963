// Cloth at rest.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/cloth_model.h"

namespace fuai {

ClothState make_cloth_state(const ClothModel& model) {
  ClothState state;
  const auto count = static_cast<std::size_t>(model.slot_count());
  for (int row = 0; row < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column) {
      const Vec2 p = model.material(column, row);
      state.positions.emplace_back(p.x(), p.y(), 0.0);
    }
  }
  state.velocities.assign(count, Vec3::Zero());
  state.accelerations.assign(count, Vec3::Zero());
  for (auto* memory :
       {&state.weft_bending, &state.warp_bending, &state.shear, &state.weft_tension, &state.warp_tension}) {
    memory->assign(count, PlayState{});
  }
  return state;
}

}  // namespace fuai
