// Builds the paper's drape test.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/paper_drape.h"

#include "fuai/core/error.h"

namespace fuai {
PaperDrape make_paper_drape(const FabricLaws& laws, const PaperDrapeOptions& options) {
  const int n = lattice_nodes_on_side(options.edge, options.spacing, "edge");
  const int fixed = lattice_nodes_on_side(options.fixed_edge, options.spacing, "fixed_edge");
  if (fixed >= n) {
    throw Error(ErrorKind::kUsage, "the fixed block must be smaller than the sheet",
                {"", 0, 0, "fixed_edge"});
  }
  LatticeSpec spec;
  spec.columns = spec.rows = n;
  spec.spacing = options.spacing;
  spec.areal_mass = laws.areal_mass;
  for (int row = 0; row < fixed; ++row) {
    for (int column = 0; column < fixed; ++column) spec.fixed_nodes.push_back(row * n + column);
  }
  PaperDrape scene;
  scene.model = std::make_unique<const LatticeModel>(make_lattice_model(spec));
  scene.laws = std::make_unique<const FabricLaws>(laws);
  scene.state = make_lattice_state(*scene.model);
  scene.solver.prepare(*scene.model, *scene.laws, options.relaxation);
  return scene;
}

}  // namespace fuai
