// Prints and keeps reports.
// SPDX-License-Identifier: Apache-2.0
#include "bench_report.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>

namespace fuai_bench {

void Report::put(const std::string& text) {
  text_ += text;
  std::fputs(text.c_str(), stdout);
  std::fflush(stdout);
}

void Report::heading(const std::string& title) { put("## " + title + "\n\n"); }

void Report::paragraph(const std::string& text) { put(text + "\n\n"); }

void Report::table(const Row& header, const std::vector<Row>& rows) {
  std::vector<std::size_t> width;
  for (const std::string& cell : header) width.push_back(std::max<std::size_t>(cell.size(), 3));
  for (const Row& row : rows) {
    for (std::size_t i = 0; i < width.size(); ++i) width[i] = std::max(width[i], row[i].size());
  }
  const auto line = [&](const Row& row) {
    std::string text = "|";
    for (std::size_t i = 0; i < width.size(); ++i)
      text += " " + row[i] + std::string(width[i] - row[i].size(), ' ') + " |";
    return text + "\n";
  };
  std::string text = line(header) + "|";
  for (std::size_t w : width) text += " " + std::string(w, '-') + " |";
  text += "\n";
  for (const Row& row : rows) text += line(row);
  put(text + "\n");
}

std::string fixed_text(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, value);
  return buffer;
}

std::string short_text(double value) {
  if (!std::isfinite(value)) return "not finite";
  const double size = std::abs(value);
  if (size > 0.0 && (size < 1e-3 || size >= 1e6)) {
    char buffer[64];
    std::snprintf(buffer, sizeof buffer, "%.2e", value);
    return buffer;
  }
  return fixed_text(value, size >= 100.0 ? 0 : size >= 10.0 ? 1 : size >= 1.0 ? 2 : 3);
}

}  // namespace fuai_bench
