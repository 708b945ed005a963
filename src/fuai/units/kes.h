// The quantities of the Kawabata Evaluation System: symbol, unit, exact factor to SI, definition, plausible
// range.
// SPDX-License-Identifier: Apache-2.0
// Source: shared definitions of the KES-FB instruments; see docs/theory/kes.md.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace fuai {

/// Every KES quantity that a fabric file can hold.
enum class Kes {
  kLT,
  kWT,
  kRT,
  kEMT,  // tensile
  kG,
  k2HG,
  k2HG5,  // shear
  kB,
  k2HB,  // bending
  kLC,
  kWC,
  kRC,  // compression
  kMIU,
  kMMD,
  kSMD,  // surface
  kT,
  kW,                 // thickness, weight
  kDrapeCoefficient,  // not KES, measured for comparison only
};

/// One quantity's definition.
struct KesQuantity {
  Kes id;
  std::string_view symbol;      ///< "2HB"
  std::string_view key;         ///< key in fabric files and --json: "2HB_gf_cm_per_cm"
  std::string_view block;       ///< section of a fabric file: "bending"
  std::string_view kes_unit;    ///< "gf·cm/cm"; "-" where there is none
  std::string_view si_unit;     ///< "N"
  double to_si;                 ///< SI value of one KES unit
  std::string_view name_en;     ///< "bending hysteresis"
  std::string_view name_ja;     ///< "曲げヒステリシス"
  std::string_view definition;  ///< how the number follows from the measured curve
  std::string_view definition_ja;
  double plausible_low;   ///< KES unit; below this real cloth is rare: warn
  double plausible_high;  ///< KES unit; above this: warn
};

/// All quantities in the order of Kes. Thread class: any.
std::span<const KesQuantity> kes_quantities();

/// The definition of one quantity. Thread class: any.
const KesQuantity& kes_quantity(Kes id);

/// Finds a quantity by its file key or its symbol ("B_gf_cm2_per_cm" or "B"); nothing when unknown.
std::optional<Kes> find_kes(std::string_view key_or_symbol);

}  // namespace fuai
