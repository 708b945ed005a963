// The one file that includes the TOML library, which takes most of a minute to compile with sanitizers.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/toml_tree.h"

#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>
#include <cstdio>

#include "fuai/core/error.h"
#include "fuai/io/toml_guard.h"

namespace fuai {
namespace {

TomlNode plain(const toml::node& node) {
  using Kind = TomlNode::Kind;
  TomlNode made;
  made.line = static_cast<int>(node.source().begin.line);
  made.column = static_cast<int>(node.source().begin.column);
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table) {
      const toml::source_position at = key.source().begin;
      made.members.push_back(
          {std::string(key.str()), static_cast<int>(at.line), static_cast<int>(at.column), plain(value)});
    }
  } else if (const toml::array* array = node.as_array()) {
    made.kind = Kind::kList;
    for (const toml::node& item : *array) made.items.push_back(plain(item));
  } else if (const auto* text = node.as_string()) {
    made.kind = Kind::kText;
    made.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    made.kind = Kind::kInteger;
    made.integer = integer->get();
    made.number = static_cast<double>(made.integer);
  } else if (const auto* number = node.as_floating_point()) {
    made.kind = Kind::kNumber;
    made.number = number->get();
  } else if (const auto* boolean = node.as_boolean()) {
    made.kind = Kind::kBoolean;
    made.boolean = boolean->get();
  } else {
    made.kind = Kind::kDate;
  }
  return made;
}

}  // namespace

const TomlNode* TomlNode::find(std::string_view key) const noexcept {
  const auto found = std::ranges::find(members, key, &TomlMember::key);
  return found == members.end() ? nullptr : &found->value;
}

TomlNode parse_toml(std::string_view text, const std::string& name) {
  check_toml_text(text, name);
  try {
    return plain(toml::parse(text));
  } catch (const toml::parse_error& e) {
    const toml::source_position at = e.source().begin;
    throw Error(ErrorKind::kBadInput, std::string(e.description()),
                Where{name, static_cast<int>(at.line), static_cast<int>(at.column), {}},
                "correct the TOML; the file may be cut off here");
  }
}

std::string toml_string(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (byte < 0x20 || byte == 0x7F) {
      char escape[8];
      std::snprintf(escape, sizeof escape, "\\u%04X", byte);
      result += escape;
    } else {
      result += c;
    }
  }
  return result + "\"";
}

}  // namespace fuai
