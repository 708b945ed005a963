// Takes the header of a table column apart: name, unit, and whatever else stands in brackets.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/units/parse.h"

namespace fuai {

/// "G (warp) [gf/(cm·deg)]" taken apart.
struct HeaderParts {
  std::string name;                 ///< the text outside of brackets: "G"
  std::vector<std::string> groups;  ///< the outermost brackets' insides, in order: "warp", "gf/(cm·deg)"
};

/// Splits a header cell at its outermost brackets, round or square, ASCII or full width. A bracket that never
/// closes is kept as part of the name. Thread class: any.
HeaderParts split_header(std::string_view header);

/// Splits at blanks, underscores and line breaks, dropping empty parts. Thread class: any.
std::vector<std::string> split_words(std::string_view text);

/// Reads words such as {"gf", "cm2", "per", "cm"}, {"percent"}, {"per", "cm"} or {"gf/cm"} as a unit;
/// everything behind "per" divides. Nothing when they are no unit. Thread class: set-up.
std::optional<Unit> unit_from_words(const std::vector<std::string>& words);

/// parse_unit() that answers nothing instead of throwing. Thread class: set-up.
std::optional<Unit> try_parse_unit(std::string_view text);

/// Lower case for ASCII letters, everything else unchanged. Thread class: any.
std::string ascii_lower(std::string_view text);

}  // namespace fuai
