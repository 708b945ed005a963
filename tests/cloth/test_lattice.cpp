// Lattices: neighbours, threads, tributary areas, refusals.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <vector>

#include "fuai/cloth/lattice.h"
#include "fuai/core/error.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("the paper's 18 x 18 lattice has every spring and triple once, and its area adds up") {
    const LatticeModel model = make_lattice_model({18, 18, 0.01, 0.2, {0, 17, 323}});
    CHECK(model.edges.size() == 2 * 17 * 18 + 2 * 17 * 17);
    CHECK(model.triples.size() == 2 * 16 * 18);
    double area = 0.0;
    for (int node = 0; node < model.node_count(); ++node) area += model.tributary_area(node);
    CHECK(area == doctest::Approx(0.17 * 0.17).epsilon(1e-14));
    std::vector<int> neighbours(18 * 18, 0);
    for (const LatticeEdge& e : model.edges) {
      const Vec3 d = model.rest_positions[static_cast<std::size_t>(e.second)] -
                     model.rest_positions[static_cast<std::size_t>(e.first)];
      CHECK(d.norm() == doctest::Approx(e.rest_length).epsilon(1e-13));
      CHECK((d.x() == 0.0) == (e.direction == Direction::kWarp));
      CHECK((d.y() == 0.0) == (e.direction == Direction::kWeft));
      ++neighbours[static_cast<std::size_t>(e.first)];
      ++neighbours[static_cast<std::size_t>(e.second)];
    }
    CHECK(neighbours[0] == 3);
    CHECK(neighbours[1] == 5);
    CHECK(neighbours[static_cast<std::size_t>(model.node(5, 7))] == 8);
    int fixed = 0;
    for (auto f : model.fixed) fixed += f;
    CHECK(fixed == 3);
    CHECK(model.fixed[17] == 1);
  }

  TEST_CASE("threads on the border carry half, and flat cloth shows its face upward") {
    const LatticeModel model = make_lattice_model({5, 4, 0.02, 0.1, {}});
    for (const LatticeTriple& t : model.triples) {
      const int column = t.middle % 5, row = t.middle / 5;
      const bool border = t.direction == Direction::kWeft ? row == 0 || row == 3 : column == 0 || column == 4;
      CHECK(t.tributary_factor == (border ? 0.5 : 1.0));
      CHECK(t.end_low + t.end_high == 2 * t.middle);
    }
    for (int node = 0; node < model.node_count(); ++node) {
      const LatticeTangents t = lattice_tangents(model, model.rest_positions, node);
      const Vec3 n = t.weft.cross(t.warp);
      CHECK(n.z() > 0.9);
      CHECK(n.head<2>().norm() < 1e-15);
    }
    const LatticeState state = make_lattice_state(model);
    CHECK(state.memory.size() == model.triples.size());
  }

  TEST_CASE("lattices that make no sense are refused") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const LatticeSpec& bad :
         {LatticeSpec{2, 5, 0.01, 0.1, {}}, LatticeSpec{5, 5000, 0.01, 0.1, {}},
          LatticeSpec{5, 5, 0.0, 0.1, {}}, LatticeSpec{5, 5, nan, 0.1, {}}, LatticeSpec{5, 5, 0.01, -0.1, {}},
          LatticeSpec{5, 5, 0.01, 0.1, {25}}, LatticeSpec{5, 5, 0.01, 0.1, {-1}}}) {
      CHECK_THROWS_AS(make_lattice_model(bad), Error);
    }
    CHECK(lattice_nodes_on_side(0.17, 0.01, "edge") == 18);
    CHECK(lattice_nodes_on_side(0.17, 0.005, "edge") == 35);
    CHECK_THROWS_AS(lattice_nodes_on_side(0.175, 0.01, "edge"), Error);
    CHECK_THROWS_AS(lattice_nodes_on_side(0.1, 0.0, "edge"), Error);
    CHECK_THROWS_AS(lattice_nodes_on_side(-0.1, 0.01, "edge"), Error);
  }
}
