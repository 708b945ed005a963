// What several commands print about a fabric: laws and assumptions, wrapped text, short sources.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "console.h"
#include "fuai/fabric/laws.h"

namespace fuai_app {

/// Columns of the narrowest terminal that the output is made for.
inline constexpr int kTextColumns = 100;

/// Columns that UTF-8 text takes; a continuation byte takes none.
int columns_of(std::string_view text);

/// Text filled with blanks to `columns`, by one blank at least.
std::string padded(std::string_view text, int columns);

/// Text cut at its first ';', then at a blank so that it keeps to `columns`; "..." stands for what was cut.
std::string shortened(std::string_view text, int columns);

/// Prints text in lines of at most kTextColumns, the first after `head`, the others indented as far as
/// `indent`.
void print_wrapped(const Console& console, const std::string& head, std::string_view text, int indent);

/// "a, b"
std::string joined(const std::vector<std::string>& words);

/// Prints each law with its origin, its residual when it repeats a measured loop, and its assumptions; fills
/// `json` with the same, one key a law.
void print_laws(const Console& console, const fuai::FabricLaws& laws, JsonValue& json);

}  // namespace fuai_app
