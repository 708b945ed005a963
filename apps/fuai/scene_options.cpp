// Reads the options of the commands that run scenes.
// SPDX-License-Identifier: Apache-2.0
#include "scene_options.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "console.h"
#include "fuai/core/error.h"
#include "fuai/io/nearest_name.h"
#include "fuai/units/parse.h"

namespace fuai_app {

using namespace fuai;

namespace {

/// find(name), whose error names the nearest of the entries too.
template <class Find, class Entries>
decltype(auto) find_named(const Find& find, const std::string& name, const Entries& entries) {
  try {
    return find(name);
  } catch (const Error& e) {
    std::vector<std::string> names;
    for (const auto& entry : entries) names.emplace_back(entry.name);
    const std::vector<std::string> nearest = nearest_names(name, names);
    throw Error(e.kind(), e.problem(), e.where(),
                (nearest.empty() ? "" : "did you mean " + nearest.front() + "? ") + e.cure());
  }
}

}  // namespace

const SceneEntry& named_scene(const std::string& name) {
  return find_named(find_scene, name, scene_entries());
}

const SolverEntry& named_solver(const std::string& name, const std::string& precision) {
  const SolverEntry& solver = find_named(find_solver, name, solver_entries());
  if (precision.empty() || precision == solver.precision) return solver;
  if (solver.kind == SolverKind::kImplicit) return solver_entry(SolverKind::kDouble);
  throw Error(ErrorKind::kUsage,
              "--precision: the solver '" + name + "' computes in " + std::string(solver.precision) + " only",
              {}, "leave --precision out");
}

void declare_size(const Command& command, int& size, std::string& spacing) {
  command.option("--size", size, "Nodes on the longer side; default: the scene's own (`fuai scenes`)")
      .range(kLeastSceneSize, kMostSceneSize);
  command.option("--spacing", spacing,
                 "Distance of the nodes with unit, e.g. 5mm; default: the scene's own, 1cm");
}

SceneOptions scene_options(int size, const std::string& spacing) {
  SceneOptions options;
  options.size = size;
  if (spacing.empty()) return options;
  options.spacing = parse_value(spacing, kLength, "--spacing");
  if (!(options.spacing >= kLeastSceneSpacing && options.spacing <= kMostSceneSpacing)) {
    throw Error(ErrorKind::kUsage, "--spacing: '" + spacing + "' is out of range", {},
                "take " + format_number(1e3 * kLeastSceneSpacing) + "mm to " +
                    format_number(1e2 * kMostSceneSpacing) + "cm");
  }
  return options;
}

double picture_width_value(const std::string& text, const char* option) {
  constexpr double kLeast = 1e-3, kMost = 10.0;
  const double width = parse_value(text, kLength, option);
  if (width >= kLeast && width <= kMost) return width;
  throw Error(ErrorKind::kUsage, std::string(option) + ": '" + text + "' is out of range", {},
              "take 1mm to 10m");
}

double time_value(const std::string& text, const char* option, bool bare) {
  const bool is_bare =
      bare && !text.empty() && (text.back() == '.' || (text.back() >= '0' && text.back() <= '9'));
  const double seconds = parse_value(text, is_bare ? kDimensionless : kTime, option);
  if (seconds < 0.0) {
    throw Error(ErrorKind::kUsage, std::string(option) + " must not be negative", {},
                "give a time such as 2s");
  }
  return seconds;
}

std::int64_t steps_of(double seconds, double dt, const char* option) {
  if (seconds > kMostSeconds) {
    throw Error(ErrorKind::kUsage,
                std::string(option) + ": " + format_number(seconds) + " s is longer than a scene runs", {},
                "take at most " + format_number(kMostSeconds) + "s");
  }
  const double steps = std::max(1.0, std::round(seconds / dt));
  if (steps > static_cast<double>(kMostSteps)) {
    throw Error(ErrorKind::kUsage,
                "the run would take " + format_number(steps) + " steps, more than ten million", {},
                "take a larger --dt or fewer --seconds");
  }
  return static_cast<std::int64_t>(steps);
}

}  // namespace fuai_app
