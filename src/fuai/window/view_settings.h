// What the window shows, and how.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/window/ui_text.h"
#include "fuai/window/view_quantity.h"

namespace fuai {

inline constexpr int kLeastLetters = 50, kMostLetters = 400;  ///< [%]

/// Choices of the user.
struct ViewSettings {
  Language language = Language::kEnglish;
  UnitSystem units = UnitSystem::kKes;
  bool dark = true;
  bool arrows = true, ground = true;
  bool lines = true;  ///< of the weave, one each spacing of the lattice
  bool yarns = true;  ///< at their true size
  bool fabric_panel = true, plots = true, help = false;
  int heat_map = -1;  ///< ClothField, -1: none
  bool auto_range = true;
  double range = 0.0;                        ///< of the heat map when it is not automatic [SI]
  double speed = 1.0;                        ///< of time
  bool caption = true, transparent = false;  ///< of screenshots
  int letters = 100;                         ///< size of everything, kLeastLetters to kMostLetters [%]
  float scale = 1.0F;  ///< of everything on the screen: that of the display times the letters
};

}  // namespace fuai
