// Builds the paper's drape test.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/paper_drape.h"

#include <cmath>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Number of nodes on a side of this length.
int node_count(double side, double spacing, const char* key) {
  const double cells = side / spacing;
  // 1e-6 of a cell: lengths are typed in decimal.
  if (!(spacing > 0.0) || !(side > 0.0) || std::abs(cells - std::round(cells)) > 1e-6) {
    throw Error(ErrorKind::kUsage, std::string(key) + " must be a positive whole multiple of the spacing",
                {"", 0, 0, key});
  }
  return static_cast<int>(std::lround(cells)) + 1;
}

}  // namespace

PaperDrape make_paper_drape(const FabricLaws& laws, const PaperDrapeOptions& options) {
  const int n = node_count(options.edge, options.spacing, "edge");
  const int fixed = node_count(options.fixed_edge, options.spacing, "fixed_edge");
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
