// Refuses TOML text that the TOML library cannot read safely.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace fuai {

/// Checks a text before toml++ 3.3 reads it:
///   - at most kMostNesting dots and brackets: they bound the depth of nested tables, and with it the stack;
///   - no character beyond ASCII outside of strings and comments, right behind a backslash, or behind a
///     continued line: the library's test for blanks is undefined for some of them (U+00A1 to U+0499, kana).
/// The first is far above any fabric file, the second is what TOML 1.0 demands anyway.
/// @param name file name for messages
/// @throws Error (kBadInput) with line and column. Thread class: set-up.
void check_toml_text(std::string_view text, const std::string& name);

/// Most dots and brackets in a file; a complete fabric file has about 150.
inline constexpr int kMostNesting = 3000;

}  // namespace fuai
