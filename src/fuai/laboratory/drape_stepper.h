// One step of a drape, by either solver.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/drape.md.
#pragma once

#include <limits>
#include <memory>

#include "fuai/cloth/cloth_model.h"
#include "fuai/laboratory/drape_method.h"
#include "fuai/solver/cloth_material.h"

namespace fuai {

/// What the tester does to the cloth at a moment.
struct DrapeMoment {
  double load = 1.0;                                        ///< part of the weight that acts [-]
  double rise = 0.0;                                        ///< of the disc [m]
  double plate = -std::numeric_limits<double>::infinity();  ///< height of the plate below the cloth [m]
};

/// Steps a specimen; made for one stage of a drape, because drag and precision belong to a stage.
class DrapeStepper {
 public:
  DrapeStepper() = default;
  DrapeStepper(const DrapeStepper&) = delete;
  DrapeStepper& operator=(const DrapeStepper&) = delete;
  virtual ~DrapeStepper() = default;

  /// Length of a step [s].
  virtual double dt() const noexcept = 0;
  /// One step; `moment` is that of its end.
  /// @return conjugate gradients it took, -1 when numbers went wrong. Thread class: real-time.
  virtual int step(const DrapeMoment& moment) noexcept = 0;
  virtual Vec3 position(int slot) const noexcept = 0;
  virtual Vec3 velocity(int slot) const noexcept = 0;
  /// Thread class: set-up.
  virtual void save(ClothState& state) const = 0;
  /// Root of the sum of the squared forces out of balance at full weight [N]; the cloth goes on as it was.
  /// Thread class: set-up.
  virtual double out_of_balance() = 0;
};

/// What a stage of a drape wants.
enum class DrapeStage {
  kGrowing,   ///< the weight grows slowly: long steps in float
  kDriven,    ///< the cloth falls, is shaken or lies on the plate: short steps in float
  kSettling,  ///< it comes to rest: long steps in double
};

/// Allocates the solver and takes over the state. Model and material must outlive it.
/// @param material with the drag of the stage
/// @throws Error (kUsage) as the solvers, and for a plate with the explicit one. Thread class: set-up.
std::unique_ptr<DrapeStepper> make_drape_stepper(const ClothModel& model, const ClothMaterial& material,
                                                 const ClothState& state, const DrapeMethod& method,
                                                 DrapeStage stage);

}  // namespace fuai
