// A clock that stands until a test moves it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai_test {

inline double fake_now = 0.0;  ///< [s]
inline double fake_clock() noexcept { return fake_now; }

}  // namespace fuai_test
