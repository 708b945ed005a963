// Takes the header of a table column apart: name, unit, and whatever else stands in brackets.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/header_cell.h"

#include <algorithm>
#include <array>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/core/text.h"

namespace fuai {
namespace {

constexpr std::array<std::string_view, 4> kOpen = {"(", "[", "（", "［"};
constexpr std::array<std::string_view, 4> kClose = {")", "]", "）", "］"};

/// Length of the token that the text starts with, 0 when it starts with none.
std::size_t starts_with_any(std::string_view text, const std::array<std::string_view, 4>& tokens) {
  for (const std::string_view token : tokens) {
    if (text.starts_with(token)) return token.size();
  }
  return 0;
}

/// Words of keys that the unit reader spells differently, and products written without a sign.
constexpr std::pair<std::string_view, std::string_view> kUnitWords[] = {
    {"percent", "%"},    {"pct", "%"},        {"gfcm2", "gf·cm2"}, {"gfcm", "gf·cm"},
    {"cmdeg", "cm·deg"}, {"cNcm2", "cN·cm2"}, {"cNcm", "cN·cm"},   {"degree", "deg"},
    {"degrees", "deg"},  {"radian", "rad"},   {"radians", "rad"},  {"micron", "um"},
};

std::string unit_word(const std::string& word) {
  for (const auto& [from, to] : kUnitWords) {
    if (word == from) return std::string(to);
  }
  return word;
}

}  // namespace

HeaderParts split_header(std::string_view header) {
  HeaderParts parts;
  std::string name, group;
  std::size_t group_begin = 0;
  int depth = 0;
  for (std::size_t at = 0; at < header.size();) {
    const std::string_view rest = header.substr(at);
    const std::size_t open = starts_with_any(rest, kOpen), close = starts_with_any(rest, kClose);
    if (open > 0 && depth++ == 0) {
      group_begin = at;
      group.clear();
    } else if (close > 0 && depth > 0 && --depth == 0) {
      parts.groups.emplace_back(trimmed(group));
      name += ' ';
    } else if (open + close > 0 && depth > 0) {
      group += open > 0 ? '(' : ')';  // inner brackets, whatever their shape
    } else {
      (depth > 0 ? group : name) += header[at];
    }
    at += std::max<std::size_t>({open, close, 1});
  }
  if (depth > 0) name += header.substr(group_begin);
  parts.name = trimmed(name);
  return parts;
}

std::vector<std::string> split_words(std::string_view text) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : text) {
    const bool separator = c == ' ' || c == '_' || c == '\n' || c == '\t';
    if (!separator) word += c;
    if (separator && !word.empty()) words.push_back(std::exchange(word, {}));
  }
  if (!word.empty()) words.push_back(word);
  return words;
}

std::optional<Unit> try_parse_unit(std::string_view text) {
  try {
    return parse_unit(text);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::optional<Unit> unit_from_words(const std::vector<std::string>& words) {
  const auto per = std::find(words.begin(), words.end(), "per");
  const auto product = [](auto begin, auto end) {
    std::string text;
    for (auto word = begin; word != end; ++word) text += (text.empty() ? "" : "·") + unit_word(*word);
    return text;
  };
  const std::string numerator = product(words.begin(), per);
  if (per == words.end()) return try_parse_unit(numerator);
  return try_parse_unit((numerator.empty() ? "1" : numerator) + "/(" + product(per + 1, words.end()) + ")");
}

std::string ascii_lower(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

}  // namespace fuai
