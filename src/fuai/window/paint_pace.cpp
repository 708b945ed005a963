// Counts pictures that are left and the time between them.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/paint_pace.h"

namespace fuai {
namespace {

/// Rates of screens are whole numbers, the screens' own are up to half a picture off. Where showing a picture
/// waits for the screen, which is exact, the pace must not come later.
constexpr double kRounding = 0.01;

}  // namespace

double PaintPace::due_in(double now) const noexcept { return at_rest() ? kNever : next_ - now; }

void PaintPace::begin(double now) noexcept {
  next_ = now + (1.0 - kRounding) / (hidden_ ? kHiddenRate : rate_);
  if (left_ > 0) --left_;
}

}  // namespace fuai
