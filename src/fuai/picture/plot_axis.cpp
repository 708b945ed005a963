// Finds ticks and writes their numbers.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/plot_axis.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "fuai/core/assertion.h"

namespace fuai {
namespace {

std::string with_minus_sign(std::string text) {
  if (!text.empty() && text[0] == '-') text = "\u2212" + text.substr(1);
  return text;
}

/// 10 to an integer power, in superscript digits.
std::string power_of_ten(int exponent) {
  constexpr const char* kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (char digit : std::to_string(std::abs(exponent))) text += kDigits[digit - '0'];
  return text;
}

/// The smallest of 1, 2, 5 times a power of ten that is at least `rough`.
double nice_step(double rough) {
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough * (1.0 - 1e-9)) return factor * power;
  }
  return 10.0 * power;
}

void add_linear_ticks(Axis& axis, int most_ticks) {
  const double span = axis.high - axis.low;
  double step = nice_step(span / most_ticks);
  const auto first_of = [&](double s) { return std::ceil(axis.low / s - 1e-9); };
  const auto last_of = [&](double s) { return std::floor(axis.high / s + 1e-9); };
  while (last_of(step) - first_of(step) + 1.0 > most_ticks) step = nice_step(1.5 * step);
  // A single number says nothing of the scale: rather one step finer (0.35 leads from 5 to 2, 2 to 1, 1 to
  // 0.5).
  while (last_of(step) - first_of(step) < 1.0) step = nice_step(0.35 * step);

  // Numbers with many zeros are written with a common power of ten.
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  int exponent = 0;
  if (largest >= 1e5 || largest < 1e-2)
    exponent = 3 * static_cast<int>(std::floor(std::log10(largest) / 3.0));
  if (exponent != 0) axis.factor = "×" + power_of_ten(exponent);
  const double unit = std::pow(10.0, exponent);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step / unit) - 1e-9)), 0, 15);
  for (double i = first_of(step); i <= last_of(step); i += 1.0)
    axis.ticks.push_back({i * step, format_number(i * step / unit, decimals)});
}

void add_logarithmic_ticks(Axis& axis, int most_ticks) {
  const int first = static_cast<int>(std::floor(std::log10(axis.low) + 1e-9));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high) - 1e-9));
  const bool few_decades = std::log10(axis.high / axis.low) < 2.0;
  const int stride = std::max(1, (last - first + most_ticks) / most_ticks);
  for (int decade = first; decade <= last; ++decade) {
    for (int factor = 1; factor < 10; ++factor) {
      const double value = factor * std::pow(10.0, decade);
      if (value < axis.low * (1.0 - 1e-9) || value > axis.high * (1.0 + 1e-9)) continue;
      std::string label;
      const bool plain = few_decades && std::abs(decade) <= 3;
      if (factor == 1 && (decade - first) % stride == 0)
        label = plain ? format_number(value) : power_of_ten(decade);
      if (plain && (factor == 2 || factor == 5)) label = format_number(value);
      axis.ticks.push_back({value, label});
    }
  }
}

}  // namespace

double Axis::place(double value) const {
  return logarithmic ? std::log(value / low) / std::log(high / low) : (value - low) / (high - low);
}

Axis make_axis(double low, double high, bool logarithmic, int most_ticks) {
  FUAI_ASSERT(std::isfinite(low) && std::isfinite(high) && low < high && (!logarithmic || low > 0.0));
  Axis axis{low, high, logarithmic, {}, {}};
  if (logarithmic) {
    add_logarithmic_ticks(axis, std::max(most_ticks, 2));
  } else {
    add_linear_ticks(axis, std::max(most_ticks, 2));
  }
  return axis;
}

std::string format_number(double value, int decimals) {
  char text[400];  // the longest double has 309 digits before the point
  std::snprintf(text, sizeof text, "%.*f", std::clamp(decimals, 0, 20), value == 0.0 ? 0.0 : value);
  return with_minus_sign(text);
}

std::string format_number(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", value == 0.0 ? 0.0 : value);
  return with_minus_sign(text);
}

}  // namespace fuai
