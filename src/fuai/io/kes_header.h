// Understands the headers of KES sheets, English and Japanese: quantity, direction, unit.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "fuai/core/types.h"
#include "fuai/units/kes.h"
#include "fuai/units/parse.h"

namespace fuai {

/// What a column (or row) of a sheet holds.
enum class SheetRole {
  kUnread,       ///< nothing that fuai knows
  kName,         ///< the fabric's name
  kCode,         ///< a short name, used when there is no name
  kComposition,  ///< fibres and weave
  kNodeCount,    ///< number of nodes of the draped specimen
  kQuantity,     ///< a KES quantity
};

/// A header taken apart.
struct SheetHeader {
  SheetRole role = SheetRole::kUnread;
  Kes quantity = Kes::kW;              ///< for kQuantity
  std::optional<Direction> direction;  ///< what the header says of it
  bool numbered = false;               ///< the direction stood as 1 or 2 ("B1", "B-2")
  bool is_mean = false;                ///< the header says that it is the mean of both directions
  std::optional<Unit> unit;            ///< the unit that the header states
};

/// Reads one header: symbol or name of a quantity with direction ("B1", "B-1", "B_warp", "B(たて)", "経B")
/// and unit
/// ("B [gf·cm²/cm]", "W_mg_per_cm2"). Full-width letters count as ASCII.
/// @throws Error (kUsage) when a header is ambiguous ("hysteresis"), or what stands in its brackets cannot be
/// read; the caller adds the place. Thread class: set-up.
SheetHeader read_sheet_header(std::string_view header);

/// Reads a cell of a units row ("(gf·cm²/cm)", "%"); nothing when it is no unit. Thread class: set-up.
std::optional<Unit> read_sheet_unit(std::string_view cell);

/// Whether the fabric model keeps the quantity by direction (bending, tensile). Thread class: any.
bool has_direction(Kes quantity);

}  // namespace fuai
