// A report of headings, sentences and tables, printed as it grows and kept as Markdown.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace fuai_bench {

using Row = std::vector<std::string>;

/// Everything goes to the screen at once and to markdown() as well: the tables are Markdown with padded
/// columns, so that one text serves both. Thread class: set-up.
class Report {
 public:
  void heading(const std::string& title);
  void paragraph(const std::string& text);
  /// @param rows each as long as the header
  void table(const Row& header, const std::vector<Row>& rows);
  const std::string& markdown() const noexcept { return text_; }

 private:
  void put(const std::string& text);
  std::string text_{};
};

/// The number with so many figures behind the point.
std::string fixed_text(double value, int decimals);
/// The number with three significant figures, without an exponent from 1e-3 to 1e6.
std::string short_text(double value);

}  // namespace fuai_bench
