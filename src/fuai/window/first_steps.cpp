// The lines of the hint.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/first_steps.h"

namespace fuai {

std::vector<TextId> FirstSteps::lines() const {
  constexpr struct {
    FirstStep step;
    TextId text;
  } kSteps[] = {{FirstStep::kGrab, TextId::kHintGrab},
                {FirstStep::kSwitch, TextId::kHintSwitch},
                {FirstStep::kCompare, TextId::kHintCompare}};
  std::vector<TextId> left;
  for (const auto& entry : kSteps)
    if ((done_ & bit(entry.step)) == 0) left.push_back(entry.text);
  return left;
}

}  // namespace fuai
