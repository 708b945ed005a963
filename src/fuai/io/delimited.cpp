// Splits comma, tab and semicolon separated text into cells that remember where they stood.
// SPDX-License-Identifier: Apache-2.0
// Source: RFC 4180 (quotes, doubled quotes, line breaks inside quotes).
#include "fuai/io/delimited.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

namespace fuai {
namespace {

constexpr std::array<char, 3> kSeparators = {'\t', ';', ','};

/// Lines that decide the separator.
constexpr int kSampleLines = 20;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

/// Without blanks before and after; a line end inside quotes is part of the cell.
std::string_view trimmed_cell(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Counts, over the first lines that hold data, in how many each separator stands outside of quotes.
char detect_separator(std::string_view text) {
  std::array<int, kSeparators.size()> votes{};
  std::array<bool, kSeparators.size()> seen{};
  bool quoted = false, has_data = false;
  int lines = 0;
  for (std::size_t at = 0; at < text.size() && lines < kSampleLines; ++at) {
    const bool starts_line = at == 0 || text[at - 1] == '\n';
    if (starts_line && !quoted && text[at] == '#') {
      at = std::min(text.find('\n', at), text.size() - 1);
      continue;
    }
    if (text[at] == '"') quoted = !quoted;
    if (!is_blank(text[at]) && text[at] != '\n') has_data = true;
    for (std::size_t i = 0; i < kSeparators.size(); ++i) {
      if (text[at] == kSeparators[i] && !quoted) seen[i] = true;
    }
    if ((text[at] == '\n' && !quoted) || at + 1 == text.size()) {
      for (std::size_t i = 0; i < kSeparators.size(); ++i) votes[i] += has_data && seen[i] ? 1 : 0;
      lines += has_data ? 1 : 0;
      seen = {};
      has_data = false;
    }
  }
  const auto best = std::max_element(votes.begin(), votes.end());  // the first of equals
  return *best == 0 ? ',' : kSeparators[static_cast<std::size_t>(best - votes.begin())];
}

/// Walks through the text once, line by line, cell by cell.
class Splitter {
 public:
  Splitter(std::string_view text, DelimitedText& table) : text_(text), table_(table) {}

  void split() {
    while (at_ < text_.size()) read_line();
  }

 private:
  void read_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    if (line_ > kMostLines) fail(at_, "the table has more than " + std::to_string(kMostLines) + " lines");
    if (trimmed_cell(line).empty() || line.front() == '#') {
      if (!trimmed_cell(line).empty())
        table_.comments.push_back({std::string(trimmed_cell(line.substr(1))), line_, 1});
      check_length(end);
      at_ = end;
      next_line();
      return;
    }
    DelimitedRow row;
    do {
      row.push_back(read_cell());
      if (row.size() > static_cast<std::size_t>(kMostCells))
        fail(at_, "the line has more than " + std::to_string(kMostCells) + " cells");
    } while (take_separator());
    check_length(at_);
    next_line();
    table_.rows.push_back(std::move(row));
  }

  DelimitedCell read_cell() {
    while (at_ < text_.size() && is_blank(text_[at_]) && text_[at_] != table_.separator) ++at_;
    DelimitedCell cell{{}, line_, column(at_)};
    if (at_ < text_.size() && text_[at_] == '"') {
      cell.text = read_quoted();
      return cell;
    }
    const std::size_t begin = at_;
    while (at_ < text_.size() && text_[at_] != table_.separator && text_[at_] != '\n') ++at_;
    cell.text = trimmed_cell(text_.substr(begin, at_ - begin));
    return cell;
  }

  /// The inside of a quoted cell; line breaks in it are kept, doubled quotes become one.
  std::string read_quoted() {
    const std::size_t open = at_++;
    const int open_line = line_, open_column = column(open);
    std::string inside;
    while (true) {
      if (at_ >= text_.size()) {
        throw Error(ErrorKind::kBadInput, "the quote that opens here never closes",
                    Where{table_.name, open_line, open_column, {}},
                    "close it, or double a quote that is meant");
      }
      const char c = text_[at_++];
      if (c == '\n') {
        check_length(at_ - 1);
        ++line_;
        line_start_ = at_;
      }
      if (c != '"') {
        inside += c;
      } else if (at_ < text_.size() && text_[at_] == '"') {
        inside += text_[at_++];
      } else {
        break;
      }
    }
    while (at_ < text_.size() && is_blank(text_[at_]) && text_[at_] != table_.separator) ++at_;
    if (at_ < text_.size() && text_[at_] != table_.separator && text_[at_] != '\n')
      fail(at_, "there is text behind the closing quote",
           "separate the cells, or double a quote that is meant");
    return std::string(trimmed_cell(inside));
  }

  bool take_separator() {
    if (at_ >= text_.size() || text_[at_] != table_.separator) return false;
    ++at_;
    return true;
  }

  void next_line() {
    if (at_ < text_.size()) ++at_;  // the line feed
    ++line_;
    line_start_ = at_;
  }

  void check_length(std::size_t end) const {
    if (end - line_start_ > static_cast<std::size_t>(kLongestLine))
      fail(line_start_, "the line is longer than " + std::to_string(kLongestLine) + " bytes");
  }

  int column(std::size_t at) const {
    return static_cast<int>(std::min<std::size_t>(at - line_start_, 1u << 30)) + 1;
  }

  [[noreturn]] void fail(std::size_t at, const std::string& what,
                         const std::string& cure = "check that this is a table of measurements") const {
    throw Error(ErrorKind::kBadInput, what, Where{table_.name, line_, column(at), {}}, cure);
  }

  std::string_view text_;
  DelimitedText& table_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
};

/// The number in a cell, finite or not; nothing when it is no number.
std::optional<double> number_of(const DelimitedText& table, const DelimitedCell& cell) {
  std::string text = cell.text;
  const bool comma_is_decimal = table.separator != ',' && text.find('.') == std::string::npos &&
                                std::count(text.begin(), text.end(), ',') == 1;
  if (comma_is_decimal) std::replace(text.begin(), text.end(), ',', '.');
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  double value = 0.0;
  const auto [stop, code] = std::from_chars(begin, end, value);
  if (stop != end || begin == end) return std::nullopt;
  if (code == std::errc::result_out_of_range) return HUGE_VAL;
  if (code != std::errc()) return std::nullopt;
  return value;
}

}  // namespace

Where DelimitedText::where(const DelimitedCell& cell, std::string_view key) const {
  return {name, cell.line, cell.column, std::string(key)};
}

DelimitedText parse_delimited(std::string_view text, const std::string& name) {
  DelimitedText table;
  table.name = name;
  table.separator = detect_separator(text);
  Splitter(text, table).split();
  if (table.rows.empty()) {
    throw Error(ErrorKind::kBadInput, "there is no line of data", Where{name, 0, 0, {}},
                "check that the file was exported completely");
  }
  return table;
}

double cell_number(const DelimitedText& table, const DelimitedCell& cell, std::string_view key) {
  const std::optional<double> value = number_of(table, cell);
  const std::string shown = "'" + (cell.text.size() > 40 ? cell.text.substr(0, 40) + "..." : cell.text) + "'";
  if (!value) {
    const bool comma = table.separator == ',' && cell.text.find(',') != std::string::npos;
    throw Error(
        ErrorKind::kBadInput, shown + " is not a number", table.where(cell, key),
        comma ? "decimal commas need semicolons or tabs between the cells" : "write a number like 0.067");
  }
  if (!std::isfinite(*value)) {
    throw Error(ErrorKind::kBadInput, shown + " is not a finite number", table.where(cell, key),
                "remove the sample or correct it");
  }
  return *value;
}

bool is_number(const DelimitedText& table, const DelimitedCell& cell) {
  return number_of(table, cell).has_value();
}

std::string csv_row(const std::vector<std::string>& cells) {
  std::string row;
  for (const std::string& text : cells) {
    if (&text != cells.data()) row += ',';
    if (text.find_first_of(",\"\r\n") == std::string::npos) {
      row += text;
      continue;
    }
    row += '"';
    for (const char c : text) {
      if (c == '"') row += '"';
      row += c;
    }
    row += '"';
  }
  return row + "\n";
}

}  // namespace fuai
