// When the window paints its next picture: no faster than its screen, and not at all where nothing changes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai {

/// The pace. Time is an argument, so that it is tested without a clock. Thread class: any, one at a time.
class PaintPace {
 public:
  /// So many pictures show everything that an event leads to: a button acts when it is let go, a picture
  /// later; the cloths of a changed setup take over another one later; a list that opens is measured first.
  static constexpr int kSettling = 5;
  /// Where nobody looks, what is recorded is still written so many times a second.
  static constexpr double kHiddenRate = 10.0;

  /// @param rate pictures a second that the screen shows, above 0
  explicit PaintPace(double rate) noexcept : rate_(rate) {}

  /// Something happened, or goes on. @param pictures that it takes to show it
  void wake(int pictures = kSettling) noexcept {
    if (pictures > left_) left_ = pictures;
  }
  bool at_rest() const noexcept { return left_ == 0; }
  void hide(bool hidden) noexcept { hidden_ = hidden; }
  /// Time until the next picture is due [s], 0 or less: now; kNever at rest. @param now on any clock [s]
  double due_in(double now) const noexcept;
  /// A picture begins.
  void begin(double now) noexcept;

  static constexpr double kNever = 1e9;  ///< [s]

 private:
  double rate_;
  double next_ = -kNever;  // [s]
  int left_ = kSettling;
  bool hidden_ = false;
};

}  // namespace fuai
