// Splits comma, tab and semicolon separated text into cells that remember where they stood.
// SPDX-License-Identifier: Apache-2.0
// Source: RFC 4180 (quotes, doubled quotes, line breaks inside quotes).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "fuai/core/error.h"

namespace fuai {

/// One cell: its text without quotes and outer blanks, and where it begins.
struct DelimitedCell {
  std::string text;
  int line = 0;    ///< 1-based
  int column = 0;  ///< 1-based, counted in bytes of the UTF-8 text
};

using DelimitedRow = std::vector<DelimitedCell>;

/// A whole table. Blank lines are dropped; lines that begin with '#' are comments, kept without the '#'.
struct DelimitedText {
  std::string name;      ///< file name for messages
  char separator = ',';  ///< ',', ';' or tab
  std::vector<DelimitedRow> rows;
  std::vector<DelimitedCell> comments;

  /// The place of a cell. @param key name of its column; the column's text is quoted in messages
  Where where(const DelimitedCell& cell, std::string_view key) const;
};

/// Longest line [bytes], most cells in a line and most lines that are accepted.
inline constexpr int kLongestLine = 65536;
inline constexpr int kMostCells = 1024;
inline constexpr int kMostLines = 2'000'000;

/// Splits a table. The separator is the one of tab, semicolon and comma that stands in most of the first
/// lines (in a tie the first of these three, so that decimal commas do not split cells).
/// @param text UTF-8 with "\n" line ends (decode_text()). @param name file name for messages
/// @throws Error (kBadInput) with line and column: a quote that never closes, text behind a closing quote, a
/// line or table beyond the limits, no line at all. Thread class: set-up.
DelimitedText parse_delimited(std::string_view text, const std::string& name);

/// Reads a cell as a finite number; a decimal comma is accepted when the separator is not a comma.
/// @param key name of the column for the message
/// @throws Error (kBadInput) with place, key and cure. Thread class: set-up.
double cell_number(const DelimitedText& table, const DelimitedCell& cell, std::string_view key);

/// Whether a cell reads as a number (finite or not). Thread class: set-up.
bool is_number(const DelimitedText& table, const DelimitedCell& cell);

/// One line of CSV: commas, quotes where a cell needs them, and the end of the line. Thread class: set-up.
std::string csv_row(const std::vector<std::string>& cells);

}  // namespace fuai
