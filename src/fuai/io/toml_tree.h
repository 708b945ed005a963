// TOML text as a tree of plain values that know where they stand; toml_tree.cpp alone includes the TOML
// library.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fuai {

struct TomlMember;

/// One value. What does not belong to its kind is empty.
struct TomlNode {
  enum class Kind { kText, kInteger, kNumber, kBoolean, kList, kTable, kDate };

  Kind kind = Kind::kTable;
  int line = 0, column = 0;         ///< 1-based
  std::string text;                 ///< of kText
  std::int64_t integer = 0;         ///< of kInteger
  double number = 0.0;              ///< of kNumber, and of kInteger
  bool boolean = false;             ///< of kBoolean
  std::vector<TomlNode> items;      ///< of kList
  std::vector<TomlMember> members;  ///< of kTable, sorted by key

  bool is_text() const noexcept { return kind == Kind::kText; }
  bool is_number() const noexcept { return kind == Kind::kInteger || kind == Kind::kNumber; }
  bool is_list() const noexcept { return kind == Kind::kList; }
  bool is_table() const noexcept { return kind == Kind::kTable; }
  /// The member of a table; null where there is none.
  const TomlNode* find(std::string_view key) const noexcept;
};

/// A key with its value.
struct TomlMember {
  std::string key;
  int line = 0, column = 0;  ///< of the key, 1-based
  TomlNode value;
};

/// Reads TOML 1.0.
/// @param text UTF-8, "\n"  @param name file name for messages
/// @throws Error (kBadInput) with line and column: broken TOML, and what check_toml_text() refuses. Thread
/// class: set-up.
TomlNode parse_toml(std::string_view text, const std::string& name);

/// A TOML basic string with its quotes. @param text UTF-8. Thread class: any.
std::string toml_string(const std::string& text);

}  // namespace fuai
