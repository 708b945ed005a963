// Constants of nature and metrology that every layer may use.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai {

/// Standard gravity [m/s2], exact by definition (3rd CGPM, 1901).
inline constexpr double kStandardGravity = 9.80665;

}  // namespace fuai
