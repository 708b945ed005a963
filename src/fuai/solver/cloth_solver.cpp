// Lists and makes the solvers.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/cloth_solver.h"

#include <array>
#include <string>

#include "fuai/core/error.h"
#include "fuai/solver/cloth_solver_explicit.h"
#include "fuai/solver/cloth_solver_implicit.h"
#include "fuai/solver/cloth_solver_paper.h"

namespace fuai {
namespace {

// In the order of SolverKind.
constexpr std::array kSolvers{
    SolverEntry{SolverKind::kImplicit, "implicit",
                "the engine: a linearised implicit step in single precision", "float", true, true, true},
    SolverEntry{SolverKind::kDouble, "double", "the same in double precision, to check", "double", true, true,
                true},
    SolverEntry{SolverKind::kExplicit, "explicit", "the oracle: many small explicit steps", "double", true,
                true, false},
    SolverEntry{SolverKind::kPaper, "paper", "the founding paper's descent, which has no time", "double",
                false, false, true},
};

}  // namespace

std::span<const SolverEntry> solver_entries() noexcept { return kSolvers; }

const SolverEntry& solver_entry(SolverKind kind) noexcept { return kSolvers[static_cast<std::size_t>(kind)]; }

const SolverEntry& find_solver(std::string_view name) {
  std::string known;
  for (const SolverEntry& entry : kSolvers) {
    if (entry.name == name) return entry;
    known += (known.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw Error(ErrorKind::kUsage, "there is no solver '" + std::string(name) + "'", {},
              "the solvers are " + known);
}

std::unique_ptr<ClothSolver> make_cloth_solver(const ClothModel& model, const ClothMaterial& material,
                                               const ClothSolverOptions& options,
                                               const AttachmentRoom& room) {
  switch (options.kind) {
    case SolverKind::kImplicit:
      return std::make_unique<ClothSolverImplicit<float>>(model, material, options.implicit, room);
    case SolverKind::kDouble:
      return std::make_unique<ClothSolverImplicit<double>>(model, material, options.implicit, room);
    case SolverKind::kExplicit:
      return std::make_unique<ClothSolverExplicit>(model, material, options.implicit, options.inner_steps,
                                                   room);
    case SolverKind::kPaper:
      return std::make_unique<ClothSolverPaper>(model, material, options.implicit, options.inner_steps, room);
  }
  throw Error(ErrorKind::kUsage, "there is no such solver");
}

}  // namespace fuai
