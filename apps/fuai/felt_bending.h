// The paper's section 4.2 with a hand: 17 x 9 particles bent through a simulated device, fabric by fabric.
// SPDX-License-Identifier: Apache-2.0
// Source: Wada, Kameda, Kakusho, Minoh, "Visual and haptic feedback for virtual cloth", section 4.2, Eq. (7).
#pragma once

#include <string>
#include <vector>

#include "fuai/core/types.h"
#include "fuai/experiments/html_page.h"

namespace fuai_app {

/// A tenth of a second, in the mean.
struct BendingMoment {
  double time = 0.0;                           ///< since the hand set out [s]
  double curvature = 0.0;                      ///< of the arc on which the tool lies [1/m]
  fuai::Vec3 tool = fuai::Vec3::Zero();        ///< [m]
  fuai::Vec3 reaction = fuai::Vec3::Zero();    ///< of the cloth on the hand [N]
  fuai::Vec3 felt = fuai::Vec3::Zero();        ///< what the device gave [N]
  fuai::Vec3 paper_bend = fuai::Vec3::Zero();  ///< Eq. (7) as printed, bending term [N]
  double pushes = 0.0;        ///< part of the reaction that pushes the hand back, to flat [N]
  double paper_pushes = 0.0;  ///< the same of paper_bend [N]
};

/// A shape of the middle yarn with the forces on the hand.
struct BendingShape {
  std::vector<fuai::Vec3> yarn;  ///< [m]
  BendingMoment moment;
};

/// There and back with a fabric.
struct FeltBending {
  std::string id, name;
  double weft_rigidity = 0.0;  ///< B of the fabric's file [N m], not a number when it has none
  std::vector<BendingMoment> moments;
  std::vector<BendingShape> shapes;  ///< at some curvatures on the way out
  double top() const;                ///< largest curvature [1/m]
  /// Pushing part at a curvature [1/m] on the way out or back, of the reaction or of the paper [N].
  double push_at(double curvature, bool back, bool paper) const;
};

/// Bends a fabric. @param fabric bundled name or path. @throws fuai::Error.
FeltBending bend_in_hand(const std::string& fabric);

/// The page, its plots as PNG and SVG, its tables as CSV. @throws fuai::Error (kNoDevice) without plots.
std::vector<fuai::OutputFile> felt_bending_page(const std::vector<FeltBending>& runs);

}  // namespace fuai_app
