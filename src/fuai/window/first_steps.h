// What a newcomer has not done yet: the lines of the hint, each of which goes away once it was done.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "fuai/window/ui_text.h"

namespace fuai {

enum class FirstStep : std::uint8_t { kGrab, kSwitch, kCompare };

/// Thread class: any.
class FirstSteps {
 public:
  void did(FirstStep step) noexcept { done_ |= bit(step); }
  /// The lines that are left, in the order in which they are best done.
  std::vector<TextId> lines() const;

 private:
  static constexpr unsigned bit(FirstStep step) noexcept { return 1U << static_cast<unsigned>(step); }
  unsigned done_ = 0;
};

}  // namespace fuai
