// Cloth pieces: areas, weights, clamps, pins, refusals.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include "cloth/piece_shapes.h"
#include "fuai/cloth/cloth_piece.h"
#include "fuai/core/error.h"

using namespace fuai;
using namespace fuai::test;

namespace {

std::size_t index(const ClothModel& m, int column, int row) {
  return static_cast<std::size_t>(m.slot(column, row));
}

ClothPieceSpec rectangle(double width, double height, double spacing) {
  ClothPieceSpec spec;
  spec.outline = make_rectangle_outline(width, height);
  spec.spacing = spacing;
  spec.areal_mass = 0.15;
  return spec;
}

/// 21 x 11 slots, 1 cm apart, held by a half plane x <= edge.
ClothModel held_strip(double edge, bool sub_cell = true) {
  ClothPieceSpec spec = rectangle(0.2, 0.1, 0.01);
  spec.clamps.push_back({HalfPlaneRegion{Vec2::UnitX(), edge}, sub_cell});
  return make_cloth_model(spec);
}

void check_refused(const ClothPieceSpec& spec, ErrorKind kind, const std::string& word) {
  try {
    make_cloth_model(spec);
    FAIL("not refused: " << word);
  } catch (const Error& error) {
    CHECK(error.kind() == kind);
    CHECK(std::string(error.what()).find(word) != std::string::npos);
    CHECK_FALSE(error.cure().empty());
  }
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a rectangle on the lattice has the classical weights") {
    const ClothModel m = make_cloth_model(rectangle(0.05, 0.03, 0.01));
    REQUIRE(m.columns == 6);
    REQUIRE(m.rows == 4);
    const double cell = 1e-4;
    const double near = 1e-14 * cell;  // rounding of the spacing squared
    for (int row = 0; row < 4; ++row) {
      for (int column = 0; column < 6; ++column) {
        const std::size_t i = index(m, column, row);
        const double across_x = column == 0 || column == 5 ? 0.5 : 1.0;
        const double across_y = row == 0 || row == 3 ? 0.5 : 1.0;
        CHECK(m.live[i] == 1);
        CHECK(m.fixed[i] == 0);
        CHECK(m.node_area[i] == relative(across_x * across_y * cell, 1e-14));
        CHECK(std::abs(m.cell_area[i] - (column < 5 && row < 3 ? cell : 0.0)) <= near);
        CHECK(std::abs(m.weft_edge_area[i] - (column < 5 ? across_y * cell : 0.0)) <= near);
        CHECK(std::abs(m.warp_edge_area[i] - (row < 3 ? across_x * cell : 0.0)) <= near);
        CHECK(std::abs(m.weft_bend_area[i] - (across_x == 1.0 ? across_y * cell : 0.0)) <= near);
        CHECK(std::abs(m.warp_bend_area[i] - (across_y == 1.0 ? across_x * cell : 0.0)) <= near);
        CHECK(m.weft_bend_length[i] == 0.01);
        CHECK(m.warp_bend_length[i] == 0.01);
      }
    }
    // Four corners and the yarns between them, all in slots.
    CHECK(m.border.size() == 2 * (5 + 3));
    for (const MaterialPoint& p : m.border) CHECK(p.weights[0] == 1.0);
  }

  TEST_CASE("a side that differs from a whole number of spacings by rounding gets no sliver of a cell") {
    for (double width : {0.05 * (1.0 - 1e-9), 0.05 * (1.0 + 1e-9), 0.1 + 0.2, 1.1 * 0.3}) {
      const ClothModel m = make_cloth_model(rectangle(width, 0.03, 0.01));
      CHECK(m.columns == static_cast<int>(std::lround(width / 0.01)) + 1);
      CHECK(m.node_area[index(m, m.columns - 1, 1)] == relative(0.5e-4, 1e-12));
      CHECK(m.weft_bend_area[index(m, m.columns - 1, 1)] == 0.0);
    }
  }

  TEST_CASE("cells with less than a tenth inside give their cloth to the neighbour") {
    // The last column holds 5 % of a cell: dropped, and its slots are dead.
    const ClothModel m = make_cloth_model(rectangle(0.0505, 0.03, 0.01));
    REQUIRE(m.columns == 7);
    CHECK(m.live[index(m, 6, 1)] == 0);
    CHECK(m.node_area[index(m, 6, 1)] == 0.0);
    CHECK(m.cell_area[index(m, 4, 1)] == relative(1.05e-4, 1e-12));
    CHECK(sum(m.cell_area) == relative(0.0505 * 0.03, 1e-12));
    // 15 %: kept; the slot outside lives, and its bending goes to the last triple.
    const ClothModel kept = make_cloth_model(rectangle(0.0515, 0.03, 0.01));
    CHECK(kept.live[index(kept, 6, 1)] == 1);
    CHECK(kept.weft_bend_area[index(kept, 6, 1)] == 0.0);
    // Its centroid is 0.075 of a spacing from the low side, so its outer corners get that part of it.
    CHECK(kept.node_area[index(kept, 6, 1)] == relative(0.075 * 0.15e-4, 1e-11));
    CHECK(kept.node_area[index(kept, 5, 1)] == relative((0.5 + 0.925 * 0.15) * 1e-4, 1e-11));
    CHECK(kept.weft_bend_area[index(kept, 5, 1)] == relative((0.5 + 0.15) * 1e-4, 1e-12));
  }

  TEST_CASE("a disc: sums equal its area") {
    for (double shift : {0.0, 0.13, 0.5, 0.77}) {
      ClothPieceSpec spec;
      spec.outline = make_disc_outline(0.3);
      spec.spacing = 0.01;
      spec.lattice_shift = Vec2(shift, 1.0 - 0.6 * shift);
      const ClothModel m = make_cloth_model(spec);
      const double area = std::numbers::pi * 0.0225;
      for (const auto* areas : {&m.node_area, &m.cell_area, &m.weft_edge_area, &m.warp_edge_area}) {
        CHECK(sum(*areas) == relative(area, 1e-12));  // rounding of a thousand terms
      }
    }
  }

  TEST_CASE("clamps: the free part of a triple at the edge of a half plane") {
    struct Case {
      double edge;  // [cells]
      int fixed;    // columns
      double s;     // edge beyond the last fixed column, which is less than half a cell outside
    };
    for (const Case& c : {Case{4.0, 5, 0.0}, Case{4.2, 5, 0.2}, Case{4.4, 5, 0.4}, Case{4.5, 5, 0.5},
                          Case{4.7, 6, -0.3}, Case{4.501, 6, -0.499}}) {
      const ClothModel m = held_strip(0.01 * c.edge);
      int fixed = 0;
      for (int column = 0; column < m.columns; ++column) fixed += m.fixed[index(m, column, 3)];
      CHECK(fixed == c.fixed);
      // The triples from the last fixed one on sum polynomials of the second degree as the integral from the
      // edge does; from the fourth on they are whole.
      const auto length = [&](int i) { return m.weft_bend_length[index(m, c.fixed - 1 + i, 3)]; };
      for (int degree = 0; degree <= 2; ++degree) {
        CAPTURE(degree);
        double sum = 0.0;
        for (int i = 0; i < 4; ++i) sum += length(i) * std::pow(i, degree);
        // Up to the middle between the fourth and the fifth, where the sum itself is a trapezoidal one: its
        // far end adds -h^2/24 f'.
        const double far = std::pow(3.5, degree + 1) / (degree + 1),
                     near = std::pow(c.s, degree + 1) / (degree + 1);
        const double far_end = degree == 0 ? 0.0 : degree * std::pow(3.5, degree - 1) / 24.0;
        CHECK(sum == relative(0.01 * (far - near - far_end), 1e-9));
      }
      CHECK(length(0) > 0.0004);
      CHECK(length(3) == 0.01);
      for (int i = 0; i < 4; ++i)
        CHECK(m.weft_bend_area[index(m, c.fixed - 1 + i, 3)] == relative(0.01 * length(i), 1e-9));
      CHECK(m.warp_bend_length[index(m, c.fixed - 1, 3)] == 0.01);  // these yarns do not leave the clamp
    }
    const ClothModel plain = held_strip(0.048, false);
    CHECK(plain.fixed[index(plain, 4, 3)] == 1);
    CHECK(plain.fixed[index(plain, 5, 3)] == 0);
    CHECK(plain.weft_bend_length[index(plain, 4, 3)] == 0.01);
  }

  TEST_CASE(
      "clamps: a yarn that ends soon hands on what it can, and two clamps that meet make Simpson's rule") {
    const auto lengths = [](const ClothPieceSpec& spec) {
      const ClothModel m = make_cloth_model(spec);
      std::array<double, 3> shares{1.0, 1.0, 1.0};  // beyond the cloth too
      for (int i = 0; i < 3 && 4 + i < m.columns; ++i)
        shares[static_cast<std::size_t>(i)] = m.weft_bend_length[index(m, 4 + i, 2)] / 0.01;
      return shares;
    };
    struct Case {
      int cells;  // along the yarn; it has no triple at its end
      std::array<double, 3> shares;
    };
    for (const Case& c : {Case{5, {0.5, 1.0, 1.0}}, Case{6, {5.0 / 12.0, 13.0 / 12.0, 1.0}},
                          Case{7, {3.0 / 8.0, 7.0 / 6.0, 23.0 / 24.0}}}) {
      CAPTURE(c.cells);
      ClothPieceSpec spec = rectangle(0.01 * c.cells, 0.04, 0.01);
      spec.clamps.push_back({HalfPlaneRegion{Vec2::UnitX(), 0.04}, true});
      const std::array<double, 3> shares = lengths(spec);
      for (std::size_t i = 0; i < 3; ++i) CHECK(shares[i] == relative(c.shares[i], 1e-9));
    }
    ClothPieceSpec spec = rectangle(0.1, 0.04, 0.01);
    spec.clamps = {{HalfPlaneRegion{Vec2::UnitX(), 0.04}, true},
                   {HalfPlaneRegion{-Vec2::UnitX(), -0.06}, true}};
    const std::array<double, 3> simpson = lengths(spec);
    CHECK(simpson[0] == relative(1.0 / 3.0, 1e-9));
    CHECK(simpson[1] == relative(4.0 / 3.0, 1e-9));
    CHECK(simpson[2] == relative(1.0 / 3.0, 1e-9));
  }

  TEST_CASE("clamps: a cell held in part is as stiff in twist as its free part") {
    // Free share of the cell that the edge cuts, in sixteenths (its samples). Beyond the middle of the cell
    // the next column is held too, and no cell in part.
    for (const auto& [edge, free] :
         {std::pair(4.25, 0.75), std::pair(4.4375, 0.5625), std::pair(4.5, 0.5), std::pair(4.75, 1.0)}) {
      const ClothModel m = held_strip(0.01 * edge);
      CHECK(m.twist_area[index(m, 4, 3)] == relative(1e-4 / free, 1e-9));
      CHECK(m.twist_area[index(m, 3, 3)] == relative(1e-4, 1e-12));  // wholly held
      CHECK(m.twist_area[index(m, 5, 3)] == relative(1e-4, 1e-12));  // wholly free
    }
    const ClothModel plain = held_strip(0.048, false);
    CHECK(plain.twist_area == plain.cell_area);
  }

  TEST_CASE("clamps: disc, rectangle and polygon measure along the yarn") {
    ClothPieceSpec spec = rectangle(0.2, 0.2, 0.01);
    spec.clamps.push_back({DiscRegion{Vec2(0.1, 0.1), 0.052}, true});
    const ClothModel disc = make_cloth_model(spec);
    // Through the centre s = 0.2; three yarns up the circle is reached at sqrt(5.2^2 - 3^2) = 4.2474.
    // Gregory's 3/8 at s = 0, see docs/theory/cloth-pieces.md.
    const auto held = [](double s) { return 0.01 * (0.375 - s + 0.75 * s * s - s * s * s / 6.0); };
    CHECK(disc.weft_bend_length[index(disc, 15, 10)] == relative(held(0.2), 1e-9));
    CHECK(disc.weft_bend_length[index(disc, 5, 10)] == relative(held(0.2), 1e-9));
    CHECK(disc.fixed[index(disc, 14, 13)] == 1);
    CHECK(disc.fixed[index(disc, 15, 13)] == 0);
    const double s = std::sqrt(5.2 * 5.2 - 9.0) - 4.0;
    CHECK(disc.weft_bend_length[index(disc, 14, 13)] == relative(held(s), 1e-9));
    for (const bool as_polygon : {false, true}) {
      spec.clamps.clear();
      PolygonRegion box = make_rectangle_region(Vec2(0.05, 0.06), Vec2(0.128, 0.15));
      if (as_polygon) box.corners.insert(box.corners.begin() + 1, Vec2(0.09, 0.06));
      spec.clamps.push_back({box, true});
      const ClothModel m = make_cloth_model(spec);
      CHECK(m.fixed[index(m, 13, 10)] == 1);  // 0.2 of a spacing outside: s = -0.2
      CHECK(m.weft_bend_length[index(m, 13, 10)] == relative(held(-0.2), 1e-9));
      CHECK(m.weft_bend_length[index(m, 5, 10)] == relative(held(0.0), 1e-9));  // on the edge: s = 0
      CHECK(m.warp_bend_length[index(m, 10, 6)] == relative(held(0.0), 1e-9));
      CHECK(m.fixed[index(m, 4, 10)] == 0);
    }
  }

  TEST_CASE("a clamp one slot wide keeps whole triples; pins fix the nearest slot") {
    ClothPieceSpec spec = rectangle(0.2, 0.2, 0.01);
    spec.clamps.push_back({DiscRegion{Vec2(0.1, 0.1), 0.001}, true});
    spec.pins.push_back(Vec2(0.034, 0.046));
    const ClothModel m = make_cloth_model(spec);
    CHECK(std::accumulate(m.fixed.begin(), m.fixed.end(), 0) == 2);
    CHECK(m.fixed[index(m, 10, 10)] == 1);
    CHECK(m.weft_bend_length[index(m, 10, 10)] == 0.01);
    CHECK(m.fixed[index(m, 3, 5)] == 1);
    CHECK(m.weft_bend_length[index(m, 3, 5)] == 0.01);
  }

  TEST_CASE("a state lies flat, at rest and virgin") {
    ClothPieceSpec spec = rectangle(0.05, 0.03, 0.01);
    spec.lattice_shift = Vec2(0.25, 0.5);
    const ClothModel m = make_cloth_model(spec);
    const ClothState state = make_cloth_state(m);
    REQUIRE(state.positions.size() == m.live.size());
    for (std::size_t i = 0; i < m.live.size(); ++i) {
      const Vec2 flat = m.material(static_cast<int>(i) % m.columns, static_cast<int>(i) / m.columns);
      CHECK(state.positions[i] == Vec3(flat.x(), flat.y(), 0.0));
      CHECK(state.velocities[i] == Vec3::Zero());
    }
    CHECK(m.origin.x() == relative(-0.0075, 1e-12));
    for (const auto* memory :
         {&state.weft_bending, &state.warp_bending, &state.shear, &state.weft_tension, &state.warp_tension}) {
      CHECK(memory->size() == m.live.size());
    }
  }

  TEST_CASE("pieces that make no sense are refused with a cure") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const ClothPieceSpec good = rectangle(0.2, 0.1, 0.01);
    const auto with_outline = [&](Polygon outline) {
      ClothPieceSpec spec = good;
      spec.outline = std::move(outline);
      return spec;
    };
    check_refused(with_outline({}), ErrorKind::kBadInput, "3 different corners");
    check_refused(with_outline({Vec2(0, 0), Vec2(1, 0), Vec2(1, 0), Vec2(0, 0)}), ErrorKind::kBadInput,
                  "3 different corners");
    check_refused(with_outline({Vec2(0, 0), Vec2(1, nan), Vec2(1, 1)}), ErrorKind::kBadInput,
                  "corner 2 is not finite");
    check_refused(with_outline({Vec2(0, 0), Vec2(1, 1), Vec2(2, 2)}), ErrorKind::kBadInput, "no area");
    check_refused(with_outline({Vec2(0, 0), Vec2(1, 1), Vec2(1, 0), Vec2(0, 2)}), ErrorKind::kBadInput,
                  "itself");
    check_refused(with_outline({Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(1, 0), Vec2(0, 2)}),
                  ErrorKind::kBadInput, "itself");
    check_refused(with_outline({Vec2(0, 0), Vec2(2, 0), Vec2(2, 2), Vec2(3, 2), Vec2(2, 2), Vec2(0, 2)}),
                  ErrorKind::kBadInput, "itself");
    for (double spacing : {0.0, -0.01, nan}) {
      ClothPieceSpec spec = good;
      spec.spacing = spacing;
      check_refused(spec, ErrorKind::kUsage, "spacing");
    }
    ClothPieceSpec spec = good;
    spec.spacing = 0.2 / 4096;
    check_refused(spec, ErrorKind::kUsage, "4096");
    spec.spacing = 0.1;
    check_refused(spec, ErrorKind::kUsage, "bend both ways");
    spec.spacing = 50.0;
    check_refused(spec, ErrorKind::kUsage, "smaller spacing");
    spec = good;
    spec.areal_mass = -0.1;
    check_refused(spec, ErrorKind::kUsage, "mass");
    spec = good;
    spec.lattice_shift = Vec2(nan, 0.0);
    check_refused(spec, ErrorKind::kUsage, "shift");
    spec = good;
    spec.clamps.push_back({DiscRegion{Vec2(1.0, 1.0), 0.05}, true});
    check_refused(spec, ErrorKind::kUsage, "holds no cloth");
    spec.clamps[0].region = DiscRegion{Vec2(0.1, 0.05), -0.05};
    check_refused(spec, ErrorKind::kUsage, "radius");
    spec.clamps[0].region = HalfPlaneRegion{Vec2(1.0, 1.0), 0.05};
    check_refused(spec, ErrorKind::kUsage, "normal");
    spec = good;
    spec.pins.push_back(Vec2(0.3, 0.0));
    check_refused(spec, ErrorKind::kUsage, "misses");
    // Two squares joined by a neck of a hundredth of a spacing.
    const Polygon dumb_bell = {Vec2(0, 0),        Vec2(0.1, 0),      Vec2(0.1, 0.05), Vec2(0.2, 0.05),
                               Vec2(0.2, 0),      Vec2(0.3, 0),      Vec2(0.3, 0.1),  Vec2(0.2, 0.1),
                               Vec2(0.2, 0.0501), Vec2(0.1, 0.0501), Vec2(0.1, 0.1),  Vec2(0, 0.1)};
    check_refused(with_outline(dumb_bell), ErrorKind::kUsage, "falls apart");
  }
}
