// How the fields of a cloth are named and in which units they are shown.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "fuai/sim/cloth_fields.h"
#include "fuai/units/kes.h"
#include "fuai/window/ui_text.h"

namespace fuai {

enum class UnitSystem : std::uint8_t { kKes, kSi };

/// A unit: what one of it is in SI, and how it is written.
struct ViewUnit {
  double to_si;
  const char* text;
};

/// A field of the heat maps.
struct ViewQuantity {
  ClothField field;
  TextId name;
  ViewUnit kes, si;
  double least_range;  ///< an automatic range is not made smaller [SI]

  const ViewUnit& unit(UnitSystem system) const { return system == UnitSystem::kKes ? kes : si; }
};

/// In the order of ClothField. Thread class: any.
std::span<const ViewQuantity> view_quantities();

/// How the unit of a KES quantity is written behind a number; empty where there is none. Thread class: any.
std::string shown_unit(const KesQuantity& quantity, UnitSystem system);

/// The pairs of live loops: their axes. Thread class: any.
struct LoopAxes {
  TextId strain, stress;
  double strain_to_si, stress_to_si;
};
enum class PlottedLoop : std::uint8_t { kBending, kShear, kTension };
LoopAxes loop_axes(PlottedLoop kind, UnitSystem system);

}  // namespace fuai
