// Writes numbers with as few digits as bring them back exactly.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/number_text.h"

#include <charconv>

namespace fuai {
namespace {

std::string with_digits(double value, int digits) {
  char text[64];
  const auto [end, code] = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
  return code == std::errc() ? std::string(text, end) : std::string("nan");
}

}  // namespace

std::string number_text(double si, double to_si) {
  constexpr int kMostDigits = 17;  // enough for any double
  const double value = si / to_si;
  for (int digits = 1; digits < kMostDigits; ++digits) {
    std::string text = with_digits(value, digits);
    double back = 0.0;
    std::from_chars(text.data(), text.data() + text.size(), back);
    if (back * to_si == si) return text;
  }
  return with_digits(value, kMostDigits);
}

std::string brief_number(double value, int digits) { return with_digits(value, digits); }

std::string fixed_number(double value, int decimals) {
  char text[512];  // the largest double has 309 digits before the point
  const auto [end, code] = std::to_chars(text, text + sizeof text, value, std::chars_format::fixed, decimals);
  return code == std::errc() ? std::string(text, end) : std::string("nan");
}

}  // namespace fuai
