// Ticks and their numbers.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fuai/picture/plot_axis.h"

using namespace fuai;

namespace {

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> found;
  for (const Tick& tick : axis.ticks) {
    if (!tick.label.empty()) found.push_back(tick.label);
  }
  return found;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("ticks stand at 1, 2 or 5 times a power of ten, with a real minus sign and no minus zero") {
    CHECK(labels(make_axis(-2.6, 2.6, false, 6)) == std::vector<std::string>{"−2", "−1", "0", "1", "2"});
    CHECK(labels(make_axis(-0.11, 0.11, false, 6)) ==
          std::vector<std::string>{"−0.10", "−0.05", "0.00", "0.05", "0.10"});
    CHECK(labels(make_axis(0.0, 100.0, false, 6)) ==
          std::vector<std::string>{"0", "20", "40", "60", "80", "100"});
    CHECK(format_number(-0.0) == "0");
    CHECK(format_number(-0.0, 2) == "0.00");
    CHECK(format_number(-12.5) == "−12.5");
  }

  TEST_CASE("very small and very large numbers share a power of ten") {
    const Axis small = make_axis(0.0, 3.1e-5, false, 6);
    CHECK(small.factor == "×10⁻⁶");
    CHECK(labels(small) == std::vector<std::string>{"0", "10", "20", "30"});
    CHECK(make_axis(0.0, 4.2e6, false, 6).factor == "×10⁶");
    CHECK(make_axis(0.0, 99.0, false, 6).factor.empty());
  }

  TEST_CASE("a logarithmic axis names its decades, over few decades also 2 and 5") {
    CHECK(labels(make_axis(1e-3, 1e4, true, 10)) ==
          std::vector<std::string>{"10⁻³", "10⁻²", "10⁻¹", "10⁰", "10¹", "10²", "10³", "10⁴"});
    CHECK(labels(make_axis(0.5, 22.0, true, 10)) ==
          std::vector<std::string>{"0.5", "1", "2", "5", "10", "20"});
    CHECK(make_axis(1.0, 100.0, true, 10).place(10.0) == doctest::Approx(0.5));
  }
}

TEST_SUITE("property") {
  TEST_CASE("any range has a few ticks, all inside, evenly spaced, with different labels") {
    const bool held = rc::check([] {
      const double scale = std::pow(10.0, *rc::gen::inRange(-9, 10));
      const double low = scale * *rc::gen::inRange(-1000, 1000) / 100.0;
      const double span = scale * *rc::gen::inRange(50, 2000) / 100.0;
      const int most = *rc::gen::inRange(2, 13);
      const Axis axis = make_axis(low, low + span, false, most);
      const auto count = static_cast<int>(axis.ticks.size());
      RC_ASSERT(count >= 2);
      RC_ASSERT(count <= std::max(most, 5));
      for (int i = 0; i < count; ++i) {
        const Tick& tick = axis.ticks[static_cast<std::size_t>(i)];
        // Range ends count as inside up to rounding.
        RC_ASSERT(axis.place(tick.value) > -1e-6);
        RC_ASSERT(axis.place(tick.value) < 1.0 + 1e-6);
        if (i == 0) continue;
        const Tick& before = axis.ticks[static_cast<std::size_t>(i - 1)];
        RC_ASSERT(tick.label != before.label);
        const double step = tick.value - before.value,
                     power = std::pow(10.0, std::floor(std::log10(step) + 1e-6));
        const double mantissa = step / power;
        RC_ASSERT(std::min({std::abs(mantissa - 1.0), std::abs(mantissa - 2.0), std::abs(mantissa - 5.0)}) <
                  1e-5);
      }
    });
    CHECK(held);
  }
}
