// Exact factors, the KES table and the reader of values with units.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/units/constants.h"
#include "fuai/units/kes.h"
#include "fuai/units/parse.h"

using namespace fuai;

TEST_SUITE("units") {
  TEST_CASE("the KES factors are the exact ones of the definition of gram-force") {
    // 1 gf = 9.80665e-3 N exactly; the rest follows. One rounding each: 2 ulp.
    const auto close = [](double a, double b) { return std::abs(a - b) <= 4e-16 * std::abs(b); };
    CHECK(close(kes_quantity(Kes::kB).to_si, 9.80665e-5));
    CHECK(close(kes_quantity(Kes::k2HB).to_si, 9.80665e-3));
    CHECK(close(kes_quantity(Kes::kWT).to_si, 0.980665));
    CHECK(close(kes_quantity(Kes::k2HG5).to_si, 0.980665));
    CHECK(close(kes_quantity(Kes::kG).to_si, 0.980665 * 180.0 / 3.14159265358979323846));
    CHECK(close(kes_quantity(Kes::kW).to_si, 0.01));
    CHECK(close(unit::kGfPerCm2, 98.0665));
  }

  TEST_CASE("the table's factor is the value of the table's own unit strings") {
    for (const KesQuantity& q : kes_quantities()) {
      CAPTURE(std::string(q.symbol));
      const Unit kes = parse_unit(q.kes_unit);
      const Unit si = parse_unit(q.si_unit);
      // T, W and the rest: the factor printed in the table must be the ratio of the two units.
      CHECK(kes.factor / si.factor == doctest::Approx(q.to_si).epsilon(1e-14));
      CHECK(kes.dimension == si.dimension);
      CHECK(q.plausible_low < q.plausible_high);
      // In Japanese: more than letters of ASCII.
      for (const std::string_view text : {q.name_ja, q.definition_ja})
        CHECK(std::ranges::any_of(text, [](char c) { return static_cast<unsigned char>(c) >= 0x80; }));
    }
  }

  TEST_CASE("every quantity is found by key and symbol, and keys are unique") {
    std::set<std::string> keys;
    for (const KesQuantity& q : kes_quantities()) {
      CHECK(find_kes(q.key) == q.id);
      CHECK(find_kes(q.symbol) == q.id);
      CHECK(&kes_quantity(q.id) == &q);
      CHECK(keys.insert(std::string(q.block) + "." + std::string(q.key)).second);
    }
    CHECK(!find_kes("B_gf"));
  }

  TEST_CASE("the spellings of one unit agree") {
    const double expected = 9.80665e-5;
    for (const char* text :
         {"gf·cm²/cm", "gf.cm2/cm", "gf*cm^2/cm", "gf cm2/cm", " gf·cm·cm/cm ", "(gf cm2)/cm"}) {
      CAPTURE(text);
      CHECK(parse_unit(text).factor == doctest::Approx(expected).epsilon(1e-15));
      CHECK(parse_unit(text).dimension == Dimension{{2, 1, -2, 0}});
    }
    CHECK(parse_unit("gf/(cm·deg)").factor == doctest::Approx(kes_quantity(Kes::kG).to_si).epsilon(1e-15));
    CHECK(parse_unit("gf/cm/deg").factor == doctest::Approx(kes_quantity(Kes::kG).to_si).epsilon(1e-15));
    CHECK(parse_unit("1/cm").factor == doctest::Approx(100.0));
    CHECK(parse_unit("cm^-1").dimension == kCurvature);
  }

  TEST_CASE("values with units") {
    CHECK(parse_value("18cm", kLength, "--disc") == doctest::Approx(0.18).epsilon(1e-15));
    CHECK(parse_value("20 gf", kForce, "--pull") == doctest::Approx(0.196133).epsilon(1e-15));
    CHECK(parse_value("1ms", kTime, "--dt") == doctest::Approx(1e-3).epsilon(1e-15));
    CHECK(parse_value("-2.5 1/cm", kCurvature, "K") == doctest::Approx(-250.0).epsilon(1e-15));
    CHECK(parse_value("45 %", kDimensionless, "x") == doctest::Approx(0.45).epsilon(1e-15));
    CHECK(parse_value("1e2", kDimensionless, "x") == 100.0);
  }

  TEST_CASE("wrong values are refused with the option's name and a cure") {
    for (const char* text :
         {"", "cm", "18", "18s", "18 gf", "18 furlong", "nan cm", "inf cm", "1e999cm", "18 cm cm", "18 cm/",
          "18 cm//s", "18 (cm", "18 cm)", "0x10cm", "18,5cm", "18 cmm"}) {
      CAPTURE(text);
      try {
        parse_value(text, kLength, "--disc");
        FAIL("accepted");
      } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::kUsage);
        CHECK(!e.cure().empty());
      }
    }
  }
}
