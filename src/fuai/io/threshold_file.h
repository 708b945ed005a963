// Reads the difference thresholds of the hand that come with fuai (data/perception/thresholds.csv).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/units/kes.h"

namespace fuai {

/// How a threshold counts.
enum class ThresholdKind {
  kFraction,    ///< a part of the value (Weber)
  kDifference,  ///< an absolute difference
};

/// One difference threshold: what a hand just tells apart.
struct Threshold {
  std::vector<Kes> quantities;  ///< what it is used for; none: listed with the reason in `remark`
  ThresholdKind kind = ThresholdKind::kFraction;
  double value = 0.0;     ///< [-] for a fraction, else [SI]
  std::string in_words;   ///< "22 %", "0.86 µm"
  std::string what;       ///< what was told apart: "lifted weight"
  std::string condition;  ///< where it holds
  std::string remark;     ///< what to think of before using it
  std::string source;     ///< who measured it, and how it was read
};

/// Reads the text of a threshold table. @param name file name for messages
/// @throws Error (kBadInput) with place and cure: no such column, a number that is not positive, a symbol
/// that is no KES quantity, a unit of another kind than the quantity's. Thread class: set-up.
std::vector<Threshold> parse_thresholds(std::string_view text, const std::string& name);

/// The bundled ones. @throws Error (kBadInput) as read_text_file(), data_folder(). Thread class: set-up.
std::vector<Threshold> bundled_thresholds();

/// The threshold that is used for a quantity; null: none is known. Thread class: any.
const Threshold* find_threshold(std::span<const Threshold> thresholds, Kes quantity) noexcept;

}  // namespace fuai
