// Recursive-descent reader of unit expressions.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/units/parse.h"

#include <charconv>
#include <cmath>
#include <string>

#include "fuai/core/error.h"
#include "fuai/core/text.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr NamedUnit kUnits[] = {
    {"m", {1.0, kLength}},
    {"cm", {unit::kCentimetre, kLength}},
    {"mm", {unit::kMillimetre, kLength}},
    {"um", {unit::kMicrometre, kLength}},
    {"µm", {unit::kMicrometre, kLength}},
    {"μm", {unit::kMicrometre, kLength}},
    {"kg", {1.0, kMass}},
    {"g", {1e-3, kMass}},
    {"mg", {1e-6, kMass}},
    {"s", {1.0, kTime}},
    {"ms", {1e-3, kTime}},
    {"us", {1e-6, kTime}},
    {"min", {60.0, kTime}},
    {"Hz", {1.0, {{0, 0, -1, 0}}}},
    {"N", {1.0, kForce}},
    {"mN", {1e-3, kForce}},
    {"uN", {1e-6, kForce}},
    {"µN", {1e-6, kForce}},
    {"cN", {unit::kCentinewton, kForce}},
    {"gf", {unit::kGramForce, kForce}},
    {"kgf", {1e3 * unit::kGramForce, kForce}},
    {"dyn", {1e-5, kForce}},
    {"Pa", {1.0, kPressure}},
    {"J", {1.0, {{2, 1, -2, 0}}}},
    {"rad", {1.0, kAngle}},
    {"deg", {unit::kDegree, kAngle}},
    {"°", {unit::kDegree, kAngle}},
    {"%", {unit::kPercent, kDimensionless}},
    {"-", {1.0, kDimensionless}},
    {"1", {1.0, kDimensionless}},
};

std::string known_names() {
  std::string list;
  for (const NamedUnit& u : kUnits) list += (list.empty() ? "" : ", ") + std::string(u.name);
  return list;
}

void multiply(Unit& into, const Unit& by, int power) {
  into.factor *= std::pow(by.factor, power);
  for (std::size_t i = 0; i < into.dimension.exponents.size(); ++i) {
    into.dimension.exponents[i] += power * by.dimension.exponents[i];
  }
}

/// Reads one expression; `depth` bounds the brackets.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : text_(text), rest_(text) {}

  Unit read_all() {
    const Unit unit = read_product(0);
    if (!rest_.empty()) fail("unexpected '" + std::string(rest_) + "'");
    return unit;
  }

 private:
  Unit read_product(int depth) {
    Unit product;
    int sign = 1;
    bool first = true;
    while (true) {
      const bool separated = skip_separators();
      if (rest_.empty() || rest_.front() == ')') {
        if (first || sign < 0) fail("a unit is missing");
        return product;
      }
      if (take("/")) {
        if (sign < 0) fail("two '/' in a row");
        if (first) fail("a unit is missing before '/'");
        sign = -1;
        continue;
      }
      if (!first && !separated && sign > 0 && rest_.front() != '(')
        fail("'·' is missing before '" + std::string(rest_) + "'");
      multiply(product, read_factor(depth), sign);
      sign = 1;
      first = false;
    }
  }

  Unit read_factor(int depth) {
    Unit factor;
    if (take("(")) {
      if (depth > 8) fail("too many brackets");
      factor = read_product(depth + 1);
      if (!take(")")) fail("')' is missing");
    } else {
      factor = read_name();
    }
    const int power = read_power();
    Unit raised;
    multiply(raised, factor, power);
    return raised;
  }

  /// The longest known name that the rest starts with and that ends at a word boundary.
  Unit read_name() {
    const NamedUnit* best = nullptr;
    for (const NamedUnit& u : kUnits) {
      if (!rest_.starts_with(u.name) || (best && u.name.size() <= best->name.size())) continue;
      const std::string_view after = rest_.substr(u.name.size());
      const bool letter_follows =
          !after.empty() && std::isalpha(static_cast<unsigned char>(after.front())) != 0;
      const bool is_word = std::isalpha(static_cast<unsigned char>(u.name.front())) != 0;
      if (!(is_word && letter_follows)) best = &u;
    }
    if (!best) fail("unknown unit '" + std::string(rest_.substr(0, rest_.find_first_of(" /*.)"))) + "'");
    rest_.remove_prefix(best->name.size());
    return best->unit;
  }

  int read_power() {
    if (take("²")) return 2;
    if (take("³")) return 3;
    const bool caret = take("^");
    int sign = 1;
    if (caret && take("-")) sign = -1;
    if (!rest_.empty() && rest_.front() >= '1' && rest_.front() <= '4') {
      const int power = rest_.front() - '0';
      rest_.remove_prefix(1);
      return sign * power;
    }
    if (caret) fail("a power from 1 to 4 is missing after '^'");
    return 1;
  }

  /// Skips blanks and product signs; true when there was one.
  bool skip_separators() {
    bool any = false;
    while (take(" ") || take("·") || take("・") || take(".") || take("*") || take("\xc2\xa0")) any = true;
    return any;
  }

  bool take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorKind::kUsage, "cannot read the unit '" + std::string(text_) + "': " + problem, {},
                "known units are " + known_names() + ", joined by '·' and '/'");
  }

  std::string_view text_, rest_;
};

}  // namespace

Unit parse_unit(std::string_view text) { return UnitReader(trimmed(text)).read_all(); }

double parse_value(std::string_view text, Dimension expected, std::string_view what) {
  const std::string_view whole = trimmed(text);
  const auto fail = [&](const std::string& problem, const std::string& cure) {
    throw Error(ErrorKind::kUsage, std::string(what) + ": " + problem + " in '" + std::string(whole) + "'",
                {}, cure);
  };
  std::string_view digits = whole;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double number = 0.0;
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (code != std::errc() || !std::isfinite(number))
    fail("no finite number", "write a number with its unit, e.g. 18cm");
  const std::string_view name = trimmed(digits.substr(static_cast<std::size_t>(end - digits.data())));
  if (name.empty()) {
    if (expected == kDimensionless) return number;
    fail("the unit is missing", "write it behind the number, e.g. 18cm, 20gf, 1ms");
  }
  const Unit unit = parse_unit(name);
  if (!(unit.dimension == expected))
    fail("the unit has the wrong dimension", "check what the option measures");
  return number * unit.factor;
}

}  // namespace fuai
