// Writes numbers with as few digits as bring them back exactly.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace fuai {

/// The shortest decimal text whose number times `to_si` is exactly `si`; when there is none (the value was
/// never read from a file), 17 digits, which bring it back within two units in the last place.
/// @param si finite value [SI]. @param to_si SI value of one unit of the text. Thread class: any.
std::string number_text(double si, double to_si = 1.0);

/// A value for a message: at most 6 significant digits, or so many. Thread class: any.
std::string brief_number(double value, int digits = 6);

/// A value with so many digits behind the point. Thread class: any.
std::string fixed_number(double value, int decimals);

}  // namespace fuai
