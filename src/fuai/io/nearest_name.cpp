// Finds the name that a misspelt word was meant to be.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/nearest_name.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace fuai {

int edit_distance(std::string_view a, std::string_view b) {
  constexpr std::size_t kLongest = 64;
  a = a.substr(0, kLongest);
  b = b.substr(0, kLongest);
  std::vector<int> row(b.size() + 1);  // distances of the first i bytes of a to every beginning of b
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    int diagonal = std::exchange(row[0], static_cast<int>(i));
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const int replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::vector<std::string> nearest_names(std::string_view word, std::span<const std::string> names, int count) {
  std::vector<std::pair<int, std::string>> ranked;
  const int farthest = static_cast<int>(std::min<std::size_t>(word.size(), 64)) / 3 + 2;
  for (const std::string& name : names) {
    const int distance = edit_distance(word, name);
    // As far as the name is long nothing of it is left.
    if (distance <= farthest && distance < static_cast<int>(name.size())) ranked.emplace_back(distance, name);
  }
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  std::vector<std::string> nearest;
  for (const auto& [distance, name] : ranked) {
    if (static_cast<int>(nearest.size()) < count) nearest.push_back(name);
  }
  return nearest;
}

std::string either(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  }
  return text;
}

}  // namespace fuai
