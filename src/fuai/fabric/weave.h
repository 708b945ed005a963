// The weave of a fabric as it is drawn: what is stated of it, and what is assumed of the rest.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/assumptions.md.
#pragma once

#include "fuai/fabric/fabric.h"

namespace fuai {

/// A weave without gaps.
struct Weave {
  WeaveStructure structure = WeaveStructure::kPlain;
  double warp_pitch = 0.0;         ///< distance of neighbouring warp yarns (of a knit: wales) [m]
  double weft_pitch = 0.0;         ///< distance of neighbouring weft yarns (of a knit: courses) [m]
  bool structure_assumed = false;  ///< plain, because neither a key nor a word says anything
  bool threads_assumed = false;    ///< neither direction is stated
};

/// The structure is that of the file, else the one that a word of composition, name or id tells ("twill",
/// "denim", "jersey", "朱子"), else plain. Of the yarns per length one direction stands for the other; where
/// neither is stated they are assumed::kWovenThreads or kKnitLoops. Thread class: any.
Weave weave_of(const Fabric& fabric);

}  // namespace fuai
