// How long work reports its progress; the command line draws the bar.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace fuai {

/// Called now and then with what is being done and the finished fraction in [0, 1]; may be empty.
using Progress = std::function<void(std::string_view what, double fraction)>;

}  // namespace fuai
