// Puts a measured curve into a fabric together with the KES parameters that follow from it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/fabric/fabric.h"

namespace fuai {

/// Stores the curve in its place (test and direction) and fills the scalars by their definitions, kind
/// "computed". A parameter that the curve does not show stays as it was; a sentence in Fabric::warnings says
/// why. A shear curve counts for both yarn directions. @throws Error (kBadInput) for tension in bias. Thread
/// class: set-up.
void add_measured_curve(Fabric& fabric, KnownCurve known);

}  // namespace fuai
