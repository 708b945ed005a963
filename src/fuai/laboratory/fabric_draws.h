// Fabrics drawn within what is not known of one fabric.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/fits.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "fuai/fabric/fabric.h"
#include "fuai/laboratory/fit_bending.h"

namespace fuai {

/// What is not known of a fabric.
struct FabricUncertainty {
  /// Deviation of ln of each measured number of bending and shear, each drawn on its own, and of a curve's
  /// stress; 5 to 20 % between laboratories and specimens.
  double scatter = 0.1;
  /// Of warp and weft where B was fitted: drawn with its friction, which both share.
  std::array<std::optional<BendingFit>, 2> bending;
  /// One fit for both directions: they share the noise too.
  bool one_fit = false;
};

/// One drawn fabric. What was measured scatters; what is assumed is drawn between its ends: 2HB / B within
/// assumed::kHysteresisSpread either way, G from kLeastShearG to kMostShearG (2HG by rule), twist from 0 to
/// kMostTwistShare. Mass, thickness and tension stay.
/// @param seed the same seed draws the same fabric. Thread class: set-up.
Fabric draw_fabric(const Fabric& fabric, const FabricUncertainty& uncertainty, std::uint64_t seed);

/// What is drawn, in plain sentences. @param drape without it only what bending along the yarns feels. Thread
/// class: set-up.
std::vector<std::string> drawn_numbers(const Fabric& fabric, const FabricUncertainty& uncertainty,
                                       bool drape = true);

}  // namespace fuai
