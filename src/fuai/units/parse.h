// Reads values with units ("18cm", "20 gf", "0.067 gf·cm²/cm") and unit expressions.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string_view>

namespace fuai {

/// Exponents of the base units; angles keep an exponent of their own so that gf/cm and gf/(cm deg) differ.
struct Dimension {
  std::array<int, 4> exponents{};  ///< metre, kilogram, second, radian
  bool operator==(const Dimension&) const = default;
};

/// A unit expression: SI value of one unit, and its dimension.
struct Unit {
  double factor = 1.0;
  Dimension dimension;
};

inline constexpr Dimension kDimensionless{{0, 0, 0, 0}};
inline constexpr Dimension kLength{{1, 0, 0, 0}};
inline constexpr Dimension kMass{{0, 1, 0, 0}};
inline constexpr Dimension kTime{{0, 0, 1, 0}};
inline constexpr Dimension kAngle{{0, 0, 0, 1}};
inline constexpr Dimension kForce{{1, 1, -2, 0}};
inline constexpr Dimension kForcePerWidth{{0, 1, -2, 0}};
inline constexpr Dimension kBendingRigidity{{2, 1, -2, 0}};
inline constexpr Dimension kCurvature{{-1, 0, 0, 0}};
inline constexpr Dimension kArealMass{{-2, 1, 0, 0}};
inline constexpr Dimension kPressure{{-1, 1, -2, 0}};

/// Parses a unit expression: names joined by "·", ".", "*" or a space (product), "/" (quotient of the next
/// factor, or of a bracket), powers as "2", "^2" or "²". "gf·cm²/cm", "gf.cm2/cm", "gf*cm^2/cm", "gf cm2/cm"
/// are the same unit.
/// "%" and "-" are dimensionless. A bare "g" is a mass; "gf" the force.
/// @throws Error (kUsage) with the offending word and the known names. Thread class: set-up.
Unit parse_unit(std::string_view text);

/// Parses "number unit" and checks the dimension. A number without a unit is refused unless `expected` is
/// dimensionless; decimal points only. Infinite and NaN values are refused.
/// @param what name of the value for the message, e.g. "--disc"
/// @return value [SI]
/// @throws Error (kUsage). Thread class: set-up.
double parse_value(std::string_view text, Dimension expected, std::string_view what);

}  // namespace fuai
