// Finds the name that a misspelt word was meant to be.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace fuai {

/// Number of letters to insert, delete or replace that turn one word into the other (Levenshtein distance of
/// bytes). Words are cut to 64 bytes. Thread class: any.
int edit_distance(std::string_view a, std::string_view b);

/// The names nearest to a word, nearest first, at most `count`, none farther than half the word's length plus
/// two. Thread class: any.
std::vector<std::string> nearest_names(std::string_view word, std::span<const std::string> names,
                                       int count = 1);

/// "a, b or c" for messages; empty for none. Thread class: any.
std::string either(std::span<const std::string> names);

}  // namespace fuai
