// What several commands print about a fabric: laws and assumptions, wrapped text, short sources.
// SPDX-License-Identifier: Apache-2.0
#include "fabric_text.h"

#include <algorithm>

namespace fuai_app {
namespace {

bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }

/// Bytes of the text that fill at most `columns`.
std::size_t bytes_of_columns(std::string_view text, int columns) {
  int used = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (starts_character(text[i]) && used++ == columns) return i;
  }
  return text.size();
}

/// Bytes of the first line: up to the last blank within `columns`, or all of them when there is none.
std::size_t first_line(std::string_view text, int columns) {
  const std::size_t most = bytes_of_columns(text, columns);
  if (most == text.size()) return most;
  const std::size_t blank = text.substr(0, most + 1).rfind(' ');
  return blank == std::string_view::npos || blank == 0 ? most : blank;
}

}  // namespace

int columns_of(std::string_view text) {
  return static_cast<int>(std::ranges::count_if(text, starts_character));
}

std::string padded(std::string_view text, int columns) {
  return std::string(text) +
         std::string(static_cast<std::size_t>(std::max(columns - columns_of(text), 1)), ' ');
}

std::string shortened(std::string_view text, int columns) {
  const std::string_view clause = text.substr(0, text.find(';'));
  if (columns_of(clause) <= columns) return std::string(clause);
  std::string_view cut = clause.substr(0, first_line(clause, columns - 4));
  while (!cut.empty() && (cut.back() == ',' || cut.back() == ' ')) cut.remove_suffix(1);
  return std::string(cut) + " ...";
}

void print_wrapped(const Console& console, const std::string& head, std::string_view text, int indent) {
  std::string line = head;
  while (true) {
    const std::size_t length = first_line(text, std::max(kTextColumns - columns_of(line), 20));
    console.line(line + std::string(text.substr(0, length)));
    text.remove_prefix(length);
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
    if (text.empty()) return;
    line = std::string(static_cast<std::size_t>(indent), ' ');
  }
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void print_laws(const Console& console, const fuai::FabricLaws& laws, JsonValue& json) {
  for (const fuai::LawReport& report : laws.reports) {
    const bool of_loop = report.origin == "measured loop";
    const double residual_percent = 100.0 * report.rms_residual_fraction;
    console.line("  " + report.law + ": " + report.origin +
                 (of_loop ? ", rms residual " + format_number(residual_percent) + " % of the peak" : ""));
    JsonValue entry, assumptions{JsonValue::Array{}};
    for (const std::string& assumption : report.assumptions) {
      print_wrapped(console, "    assumed: ", assumption, 13);
      assumptions.push(assumption);
    }
    // Only a law made from a loop has a residual of its own; null says so.
    entry.set("origin", report.origin);
    entry.set("rms_residual_percent", of_loop ? JsonValue(residual_percent) : JsonValue());
    entry.set("assumptions", std::move(assumptions));
    json.set(report.law, std::move(entry));
  }
}

}  // namespace fuai_app
