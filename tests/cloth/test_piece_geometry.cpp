// Cloth pieces against the geometry of their outlines: borders, meshes, centres of mass, random shapes.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "cloth/piece_shapes.h"
#include "fuai/cloth/cloth_piece.h"
#include "fuai/cloth/material_point.h"
#include "fuai/cloth/piece_mesh.h"
#include "fuai/core/error.h"

using namespace fuai;
using namespace fuai::test;

namespace {

struct Shape {
  const char* name;
  Polygon outline;
};

std::vector<Shape> shapes() {
  // Sides so short (0.3 mm) that their own chords do not show.
  return {{"disc", make_disc_outline(0.3, 2880)},
          {"turned rectangle", rotate_outline(make_rectangle_outline(0.31, 0.18), 0.4)},
          {"sleeve", sleeve_outline(1000)}};
}

const std::vector<Vec2> kShifts = {Vec2(0.0, 0.0), Vec2(0.37, 0.81), Vec2(0.52, 0.24), Vec2(0.9, 0.55)};

ClothModel cut(const Polygon& outline, double spacing, const Vec2& shift) {
  ClothPieceSpec spec;
  spec.outline = outline;
  spec.spacing = spacing;
  spec.areal_mass = 0.15;
  spec.lattice_shift = shift;
  return make_cloth_model(spec);
}

std::vector<Vec3> border_positions(const ClothModel& model, const std::vector<Vec3>& positions) {
  std::vector<Vec3> border;
  for (const MaterialPoint& point : model.border) border.push_back(material_position(point, positions));
  return border;
}

/// The flat cloth rolled without stretch on a cylinder of 15 cm radius whose axis is aslant to the yarns.
std::vector<Vec3> rolled(const ClothModel& model) {
  const double radius = 0.15;
  const Vec2 round(std::cos(0.43), std::sin(0.43)), along(-round.y(), round.x());
  std::vector<Vec3> positions;
  for (const Vec3& flat : make_cloth_state(model).positions) {
    const double angle = flat.head<2>().dot(round) / radius;
    positions.emplace_back(radius * std::sin(angle), flat.head<2>().dot(along), radius * std::cos(angle));
  }
  return positions;
}

/// Mean size of the strain of the border between its points [-]. The strains have both signs: this bounds the
/// error of the whole length and does not profit from their cancelling.
double border_stretch(const ClothModel& model, const std::vector<Vec3>& positions) {
  const std::vector<Vec3> border = border_positions(model, positions);
  double change = 0.0;
  for (std::size_t i = 0; i < border.size(); ++i) {
    const std::size_t j = (i + 1) % border.size();
    change += std::abs((border[j] - border[i]).norm() -
                       (model.border[j].material - model.border[i].material).norm());
  }
  return change / polygon_perimeter(model.outline);
}

double mesh_area(const SurfaceMesh& mesh, double& least) {
  double area = 0.0;
  least = 1.0;
  for (const auto& t : mesh.triangles) {
    const auto p = [&](std::size_t i) { return mesh.positions[static_cast<std::size_t>(t[i])]; };
    const double triangle = 0.5 * (p(1) - p(0)).cross(p(2) - p(0)).z();
    area += triangle;
    least = std::min(least, triangle);
  }
  return area;
}

/// Slope of the logarithm of errors at spacings that halve, least squares.
double order(const std::vector<double>& errors) {
  double numerator = 0.0, denominator = 0.0;
  const double middle = 0.5 * (static_cast<double>(errors.size()) - 1.0);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double step = static_cast<double>(i) - middle;
    numerator -= step * std::log2(errors[i]);
    denominator += step * step;
  }
  return numerator / denominator;
}

/// The largest error over the shifts, at spacings 20, 10, 5 and 2.5 mm.
template <class Error>
std::vector<double> worst_errors(const Shape& shape, Error&& error) {
  std::vector<double> errors;
  for (double spacing : {0.02, 0.01, 0.005, 0.0025}) {
    double worst = 0.0;
    for (const Vec2& shift : kShifts) worst = std::max(worst, error(cut(shape.outline, spacing, shift)));
    errors.push_back(worst);
  }
  return errors;
}

/// A point is a mean of live slots that says where it is.
bool is_sound(const MaterialPoint& point, const ClothModel& model) {
  Vec2 place = Vec2::Zero();
  double total = 0.0, size = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const int slot = point.slots[i];
    if (model.live[static_cast<std::size_t>(slot)] == 0) return false;
    place += point.weights[i] * model.material(slot % model.columns, slot / model.columns);
    total += point.weights[i];
    size += std::abs(point.weights[i]);
  }
  const double rounding = 1e-13 * size * size;  // far extrapolation cancels
  return std::abs(total - 1.0) < rounding && (place - point.material).norm() < rounding;
}

/// Everything that must hold for any piece; the name of the first rule that does not.
std::string broken_rule(const ClothModel& m) {
  const double area = polygon_area(m.outline);
  const auto differs = [&](double a) { return std::abs(a - area) > 1e-12 * area; };
  if (differs(sum(m.node_area)) || differs(sum(m.cell_area))) return "node or cell sum";
  if (differs(sum(m.weft_edge_area)) || differs(sum(m.warp_edge_area))) return "edge sum";
  for (int slot = 0; slot < m.slot_count(); ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    const auto live = [&](int s) {
      return s >= 0 && s < m.slot_count() && m.live[static_cast<std::size_t>(s)] == 1;
    };
    if ((m.live[i] == 1) != (m.node_area[i] > 0.0)) return "live iff area";
    for (double a : {m.cell_area[i], m.weft_edge_area[i], m.warp_edge_area[i], m.weft_bend_area[i],
                     m.warp_bend_area[i]}) {
      if (a < 0.0 || (a > 0.0 && !live(slot))) return "area in a dead slot";
    }
    if (m.cell_area[i] > 0.0 && !(live(slot + 1) && live(slot + m.columns) && live(slot + m.columns + 1)))
      return "cell corner";
    if (m.weft_edge_area[i] > 0.0 && !live(slot + 1)) return "weft edge end";
    if (m.warp_edge_area[i] > 0.0 && !live(slot + m.columns)) return "warp edge end";
    if (m.weft_bend_area[i] > 0.0 && !(live(slot - 1) && live(slot + 1))) return "weft triple";
    if (m.warp_bend_area[i] > 0.0 && !(live(slot - m.columns) && live(slot + m.columns)))
      return "warp triple";
  }
  if (sum(m.weft_bend_area) > area * (1.0 + 1e-12) || sum(m.warp_bend_area) > area * (1.0 + 1e-12))
    return "bend sum";
  for (const MaterialPoint& p : m.border) {
    if (!is_sound(p, m)) return "border point";
  }
  const std::vector<Vec3> flat = make_cloth_state(m).positions;
  // A crossing within 1e-6 of a spacing of a corner is left out; it is on the side, so no length is lost.
  const double length = closed_length(border_positions(m, flat)), perimeter = polygon_perimeter(m.outline);
  if (std::abs(length - perimeter) > 1e-11 * perimeter) return "border length";
  const PieceMesh piece = make_piece_mesh(m, flat);
  for (const MaterialPoint& p : piece.vertices) {
    if (!is_sound(p, m)) return "mesh vertex";
  }
  double least = 0.0;
  if (std::abs(mesh_area(piece.mesh, least) - area) > 1e-9 * area) return "mesh area";
  if (least < 0.0) return "flipped triangle";
  return "";
}

/// A polygon that goes once round a point, with spikes and notches; sometimes its corners lie on slots or
/// yarns.
Polygon random_star(double spacing) {
  const int corners = *rc::gen::inRange(3, 24);
  const int grid = *rc::gen::element(0, 0, 1, 2);
  const int least = *rc::gen::element(5, 30, 80);  // [mm]
  Polygon outline;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.01 * *rc::gen::inRange(0, 90)) / corners;
    const double radius = 0.001 * *rc::gen::inRange(least, 120);
    Vec2 p(radius * std::cos(angle), radius * std::sin(angle));
    if (grid > 0) p = (p / spacing * grid).array().round().matrix() * spacing / grid;
    outline.push_back(p);
  }
  return outline;
}

/// A comb with slits of any width between its teeth, some on lattice lines, turned by any angle or not at
/// all.
Polygon random_comb(double spacing) {
  Polygon outline = {Vec2(0.0, 0.0)};
  const int teeth = *rc::gen::inRange(1, 6);
  std::vector<Vec2> top;
  double x = 0.0;
  for (int i = 0; i < teeth; ++i) {
    const double height = spacing * *rc::gen::inRange(40, 80) / 10.0;
    const double width = spacing * *rc::gen::inRange(1, 60) / 10.0,
                 slit = spacing * *rc::gen::inRange(1, 30) / 10.0;
    const double bottom = spacing * *rc::gen::inRange(10, 40) / 10.0;
    if (i > 0) {
      top.emplace_back(x, bottom);
      top.emplace_back(x + slit, bottom);
      x += slit;
    }
    top.emplace_back(x, height);
    top.emplace_back(x += width, height);
  }
  outline.emplace_back(x, 0.0);
  outline.insert(outline.end(), top.rbegin(), top.rend());
  return rotate_outline(outline, *rc::gen::element(0.0, 0.5 * std::numbers::pi, 0.3, -1.1));
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the mesh of a rectangle on the lattice is the lattice's mesh") {
    const ClothModel m = cut(make_rectangle_outline(0.05, 0.03), 0.01, Vec2::Zero());
    const std::vector<Vec3> flat = make_cloth_state(m).positions;
    const PieceMesh piece = make_piece_mesh(m, flat);
    const SurfaceMesh lattice = make_lattice_mesh(6, 4, 0.01, flat);
    REQUIRE(piece.mesh.triangles.size() == lattice.triangles.size());
    CHECK(piece.mesh.positions.size() == lattice.positions.size());
    for (std::size_t t = 0; t < lattice.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = piece.mesh.positions[static_cast<std::size_t>(piece.mesh.triangles[t][k])];
        CHECK((p - flat[static_cast<std::size_t>(lattice.triangles[t][k])]).norm() < 1e-16);
      }
    }
  }

  TEST_CASE("a mesh is one sheet: every side has one or two triangles, and the border is the outline") {
    for (const Shape& shape : shapes()) {
      CAPTURE(shape.name);
      const ClothModel m = cut(shape.outline, 0.01, Vec2(0.37, 0.81));
      PieceMesh piece = make_piece_mesh(m, make_cloth_state(m).positions);
      std::map<std::pair<int, int>, int> sides;
      for (const auto& t : piece.mesh.triangles) {
        for (std::size_t k = 0; k < 3; ++k) ++sides[{t[k], t[(k + 1) % 3]}];
      }
      double border = 0.0;
      for (const auto& [side, count] : sides) {
        REQUIRE(count == 1);  // each side once in each sense
        if (sides.count({side.second, side.first}) != 0) continue;
        border += (piece.mesh.material[static_cast<std::size_t>(side.first)] -
                   piece.mesh.material[static_cast<std::size_t>(side.second)])
                      .norm();
      }
      // A crack inside would show as more border. Tolerance: sides shorter than rounding are not
      // triangulated.
      CHECK(border == relative(polygon_perimeter(m.outline), 1e-9));
      const std::vector<Vec3> moved = rolled(m);
      update_piece_mesh(piece, moved);
      const PieceMesh anew = make_piece_mesh(m, moved);
      CHECK(piece.mesh.positions == anew.mesh.positions);
    }
  }
}

TEST_SUITE("property") {
  TEST_CASE("the centre of mass of the nodes is that of the outline") {
    for (const Shape& shape : shapes()) {
      CAPTURE(shape.name);
      // Every cell keeps its first moment, so nothing but the rounding of some 1e4 terms is left; measured
      // 3e-14 m at most. These shapes drop cells at every spacing, but none so far from its taker that the
      // common centroid comes within 1/20 of a side.
      for (double error : worst_errors(shape, [](const ClothModel& m) {
             return (centre_of_nodes(m) - polygon_centroid(m.outline)).norm();
           }))
        CHECK(error < 1e-12);
    }
  }

  TEST_CASE("areas, border and mesh of three shapes at four spacings and shifts") {
    for (const Shape& shape : shapes()) {
      for (double spacing : {0.02, 0.01, 0.005, 0.0025}) {
        for (const Vec2& shift : kShifts) {
          CAPTURE(shape.name);
          CAPTURE(spacing);
          const ClothModel m = cut(shape.outline, spacing, shift);
          CHECK(broken_rule(m) == "");
          // All but the corners lie on a yarn and hang on two of its slots.
          const auto hangs_on_four = [](const MaterialPoint& p) { return p.weights[2] != 0.0; };
          CHECK(std::count_if(m.border.begin(), m.border.end(), hangs_on_four) <= std::ssize(m.outline));
        }
      }
    }
  }

  TEST_CASE("random polygons keep every rule") {
    int built = 0, refused = 0;
    CHECK(rc::check("rules for twenty pieces at a time", [&] {
      for (int piece = 0; piece < 20; ++piece) {
        const double spacing = 0.001 * *rc::gen::inRange(3, 15);
        const Vec2 shift(*rc::gen::element(0.0, 0.0, 0.25, 0.5, 0.731),
                         *rc::gen::element(0.0, 0.0, 0.5, 0.119));
        const Polygon outline = *rc::gen::element(0, 1) == 0 ? random_star(spacing) : random_comb(spacing);
        ClothModel model;
        try {
          model = cut(outline, spacing, shift);
        } catch (const Error&) {  // too coarse, or rounded onto itself
          ++refused;
          continue;
        }
        ++built;
        const std::string broken = broken_rule(model);
        RC_LOG() << broken << " spacing " << spacing;
        RC_ASSERT(broken == "");
      }
    }));
    CHECK(built > refused);
  }
}

TEST_SUITE("convergence") {
  TEST_CASE("the border of rolled cloth has the length of the outline, with order 2") {
    for (const Shape& shape : shapes()) {
      CAPTURE(shape.name);
      const std::vector<double> lengths = worst_errors(shape, [](const ClothModel& m) {
        return std::abs(closed_length(border_positions(m, rolled(m))) / polygon_perimeter(m.outline) - 1.0);
      });
      CAPTURE(lengths[1]);
      // Demanded of every border: 0.02 % at 1 cm. Measured 0.002, 0.017, 0.007 % (disc, rectangle, sleeve).
      CHECK(lengths[1] < 2e-4);
      const std::vector<double> strains =
          worst_errors(shape, [](const ClothModel& m) { return border_stretch(m, rolled(m)); });
      CAPTURE(strains[0]);
      CAPTURE(strains[3]);
      // Chords of the cylinder, and kinks of second order between cells. Measured orders 2.39, 2.00, 2.34.
      CHECK(order(strains) > 1.95);
    }
  }
}
