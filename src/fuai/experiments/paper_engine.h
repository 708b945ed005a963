// The paper's drape and strip on the cloth engine: at rest under threads as stiff as they were measured.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", sections 4.1, 4.2.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fuai/cloth/cloth_model.h"
#include "fuai/core/progress.h"
#include "fuai/solver/equilibrium.h"

namespace fuai {

/// A drape of Figure 4 on the engine. The nodes of the block are fixed, as in the paper.
struct EngineDrape {
  std::string id, name;
  double spacing = 0.0;  ///< [m]
  ClothModel model;
  ClothState state;
  EquilibriumReport report;
  double corner_z = 0.0, side_z = 0.0;  ///< of the free corner and of the one beside the block [m]
  double max_strain = 0.0;              ///< largest of a yarn edge [-]
  double residual = 0.0;  ///< force out of balance, root of the sum of squares: no less than the
                          ///< largest on a node, in weights of a node
  double seconds = 0.0;   ///< wall clock
};

/// Drapes a bundled fabric, let go from flat. A sheet finer than the paper's starts from the shape of the
/// paper's spacing, so that both show the same one of the many shapes of rest.
/// @param spacing [m], a whole part of the paper's 17 cm. Thread class: set-up.
EngineDrape drape_on_engine(const std::string& fabric_id, double spacing, const Progress& progress);

/// A stage of the strip of Figures 6 to 8.
struct EngineBendingStage {
  double arc_curvature = 0.0;    ///< [1/m]
  Vec3 reaction = Vec3::Zero();  ///< of the cloth on the hand [N]
  double max_strain = 0.0;       ///< [-]
  EquilibriumReport report;      ///< residual in [N]
  std::vector<Vec3> positions;   ///< [m] (slots)
};

struct EngineStrip {
  std::string id, name;
  double spacing = 0.0;  ///< [m]
  ClothModel model;
  int grip = 0;  ///< slot that is held
  std::vector<EngineBendingStage> stages;
  double seconds = 0.0;
};

/// Moves the grip of the strip along the arc through the curvatures [1/m], in their order.
/// @param spacing [m], a whole part of the paper's 1 cm. Thread class: set-up.
EngineStrip bend_on_engine(const std::string& fabric_id, double spacing, std::span<const double> curvatures,
                           const Progress& progress);

}  // namespace fuai
