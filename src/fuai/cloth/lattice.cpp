// Builds lattices: neighbours, threads, tributary areas.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/cloth/lattice.h"

#include <cmath>
#include <numbers>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr int kMostNodesASide = 4096;

void validate(const LatticeSpec& spec) {
  for (int n : {spec.columns, spec.rows}) {
    if (n < 3 || n > kMostNodesASide) {
      throw Error(ErrorKind::kUsage, "a lattice needs 3 to 4096 nodes a side, got " + std::to_string(n));
    }
  }
  if (!(spec.spacing > 0.0) || !std::isfinite(spec.spacing)) {
    throw Error(ErrorKind::kUsage, "the spacing of a lattice must be positive", {"", 0, 0, "spacing"});
  }
  if (!(spec.areal_mass >= 0.0) || !std::isfinite(spec.areal_mass)) {
    throw Error(ErrorKind::kUsage, "the mass of a cloth must not be negative", {"", 0, 0, "areal_mass"});
  }
  for (int node : spec.fixed_nodes) {
    if (node < 0 || node >= spec.columns * spec.rows) {
      throw Error(ErrorKind::kUsage, "fixed node " + std::to_string(node) + " does not exist");
    }
  }
}

/// 1/2 when an index is the first or last of n, else 1.
double border_factor(int index, int n) { return index == 0 || index == n - 1 ? 0.5 : 1.0; }

/// Adds the edges from every node to the one `right` columns and `up` rows on, where it exists.
void add_edges(LatticeModel& model, int right, int up, Direction direction) {
  const double rest_length = model.spacing * (right != 0 && up != 0 ? std::numbers::sqrt2 : 1.0);
  for (int row = 0; row + up < model.rows; ++row) {
    for (int column = 0; column < model.columns; ++column) {
      if (column + right < 0 || column + right >= model.columns) continue;
      double factor = 1.0;
      if (direction == Direction::kWeft) factor = border_factor(row, model.rows);
      if (direction == Direction::kWarp) factor = border_factor(column, model.columns);
      model.edges.push_back(
          {model.node(column, row), model.node(column + right, row + up), direction, rest_length, factor});
    }
  }
}

void add_triples(LatticeModel& model, Direction direction) {
  const int right = direction == Direction::kWeft ? 1 : 0, up = 1 - right;
  for (int row = up; row + up < model.rows; ++row) {
    for (int column = right; column + right < model.columns; ++column) {
      const double factor =
          right != 0 ? border_factor(row, model.rows) : border_factor(column, model.columns);
      model.triples.push_back({model.node(column - right, row - up), model.node(column, row),
                               model.node(column + right, row + up), direction, factor});
    }
  }
}

}  // namespace

LatticeModel make_lattice_model(const LatticeSpec& spec) {
  validate(spec);
  LatticeModel model;
  model.columns = spec.columns;
  model.rows = spec.rows;
  model.spacing = spec.spacing;
  model.areal_mass = spec.areal_mass;
  for (int row = 0; row < spec.rows; ++row) {
    for (int column = 0; column < spec.columns; ++column) {
      model.rest_positions.emplace_back(column * spec.spacing, row * spec.spacing, 0.0);
      model.tributary_factors.push_back(border_factor(row, spec.rows) * border_factor(column, spec.columns));
    }
  }
  model.fixed.assign(model.rest_positions.size(), 0);
  for (int node : spec.fixed_nodes) model.fixed[static_cast<std::size_t>(node)] = 1;
  add_edges(model, 1, 0, Direction::kWeft);
  add_edges(model, 0, 1, Direction::kWarp);
  add_edges(model, 1, 1, Direction::kBias);
  add_edges(model, -1, 1, Direction::kBias);
  add_triples(model, Direction::kWeft);
  add_triples(model, Direction::kWarp);
  return model;
}

int lattice_nodes_on_side(double length, double spacing, const char* key) {
  const double cells = length / spacing;
  if (!(spacing > 0.0) || !(cells > 0.0 && cells < kMostNodesASide) ||
      std::abs(cells - std::round(cells)) > 1e-6) {
    throw Error(ErrorKind::kUsage, "a side must be a positive whole multiple of the spacing", {"", 0, 0, key},
                "give a length that the spacing divides");
  }
  return static_cast<int>(std::lround(cells)) + 1;
}

LatticeState make_lattice_state(const LatticeModel& model) {
  return {model.rest_positions, std::vector<PlayState>(model.triples.size())};
}

LatticeTangents lattice_tangents(const LatticeModel& model, std::span<const Vec3> positions,
                                 int node) noexcept {
  const int column = node % model.columns, row = node / model.columns;
  const auto at = [&](int n) -> const Vec3& { return positions[static_cast<std::size_t>(n)]; };
  // Sum of the unit vectors along one thread, both pointing the way of growing index.
  const auto tangent = [&](int index, int count, int stride) {
    Vec3 sum = Vec3::Zero();
    if (index > 0) sum += (at(node) - at(node - stride)).normalized();
    if (index + 1 < count) sum += (at(node + stride) - at(node)).normalized();
    return sum;
  };
  return {tangent(column, model.columns, 1), tangent(row, model.rows, model.columns)};
}

}  // namespace fuai
