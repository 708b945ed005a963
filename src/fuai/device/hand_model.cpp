// Simulated hands.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/hand_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/core/smooth_rise.h"

namespace fuai {
namespace {

constexpr std::array kHands{
    HandModel{"none", 0.0, 0.0, 0.0},       // the device alone: nothing but its own losses
    HandModel{"finger", 0.01, 2.0, 300.0},  // light fingertip, within the range of Hajian and Howe 1997
    HandModel{"stylus", 0.15, 5.0, 400.0},  // a pen grip; assumed, between finger and arm
    HandModel{"arm", 0.554, 6.45, 135.0},   // holding a handle: van Beek et al. 2015, Fig. 3
    HandModel{"heavy", 2.0, 2.0, 10.0},     // operator of Yokokohji and Yoshikawa 1994
};

class Still : public HandMotion {
 public:
  explicit Still(const Vec3& position) : position_(position) {}
  HandTarget at(double) const noexcept override { return {position_, Vec3::Zero()}; }

 private:
  Vec3 position_;
};

class Reach : public HandMotion {
 public:
  Reach(const Vec3& start, const Vec3& way, HandTimes times)
      : start_(start), way_(way), times_(times), middle_(0.5 * (times.begins + times.ends)) {}
  HandTarget at(double time) const noexcept override {
    const double there = smooth_rise(time, times_.begins, middle_) - smooth_rise(time, middle_, times_.ends);
    const double rate =
        smooth_rise_rate(time, times_.begins, middle_) - smooth_rise_rate(time, middle_, times_.ends);
    return {start_ + there * way_, rate * way_};
  }

 private:
  Vec3 start_, way_;
  HandTimes times_;
  double middle_;
};

// way (1 - cos phi) / 2 with phi' = 2 pi (slow + (fast - slow) s), s from 0 to 1; `fast` gives way so that
// the last turn is whole.
class Chirp : public HandMotion {
 public:
  Chirp(const Vec3& start, const Vec3& way, HandTimes times, double slow, double fast)
      : start_(start), way_(way), times_(times), slow_(slow) {
    const double lasts = times.ends - times.begins;
    const double turns = std::max(1.0, std::round(0.5 * (slow + fast) * lasts));
    fast_ = 2.0 * turns / lasts - slow;
  }
  HandTarget at(double time) const noexcept override {
    const double lasts = times_.ends - times_.begins;
    const double t = std::clamp(time - times_.begins, 0.0, lasts);
    const double turn = 2.0 * std::numbers::pi;
    const double phase = turn * (slow_ * t + 0.5 * (fast_ - slow_) * t * t / lasts);
    const double rate = turn * (slow_ + (fast_ - slow_) * t / lasts);
    const bool moves = t > 0.0 && t < lasts;
    return {start_ + 0.5 * (1.0 - std::cos(phase)) * way_,
            (moves ? 0.5 * std::sin(phase) * rate : 0.0) * way_};
  }

 private:
  Vec3 start_, way_;
  HandTimes times_;
  double slow_, fast_ = 0.0;
};

class Release : public HandMotion {
 public:
  Release(const Vec3& start, const Vec3& way, double time) : start_(start), way_(way), time_(time) {}
  HandTarget at(double time) const noexcept override {
    return {time < time_ ? Vec3(start_ + way_) : start_, Vec3::Zero()};
  }

 private:
  Vec3 start_, way_;
  double time_;
};

class Path : public HandMotion {
 public:
  Path(std::vector<Vec3> points, double step) : points_(std::move(points)), step_(step) {}
  HandTarget at(double time) const noexcept override {
    const double last = static_cast<double>(points_.size() - 1);
    const double place = std::clamp(time / step_, 0.0, last);
    const auto from = static_cast<std::size_t>(std::min(std::floor(place), std::max(last - 1.0, 0.0)));
    const Vec3 way = points_.size() > 1 ? Vec3(points_[from + 1] - points_[from]) : Vec3(Vec3::Zero());
    const bool moves = time >= 0.0 && place < last;
    return {points_[from] + (place - static_cast<double>(from)) * way,
            moves ? Vec3(way / step_) : Vec3(Vec3::Zero())};
  }

 private:
  std::vector<Vec3> points_;
  double step_;
};

void check_times(HandTimes times) {
  if (!(times.ends > times.begins))
    throw Error(ErrorKind::kUsage, "a hand's motion must end after it begins");
}

}  // namespace

std::span<const HandModel> hand_models() noexcept { return kHands; }

const HandModel& find_hand_model(std::string_view name) {
  std::string names;
  for (const HandModel& hand : kHands) {
    if (hand.name == name) return hand;
    names += (names.empty() ? "" : ", ") + std::string(hand.name);
  }
  throw Error(ErrorKind::kUsage, "there is no hand '" + std::string(name) + "'", {"", 0, 0, "hand"},
              "take one of " + names);
}

std::unique_ptr<const HandMotion> make_still_motion(const Vec3& position) {
  return std::make_unique<Still>(position);
}

std::unique_ptr<const HandMotion> make_reach_motion(const Vec3& start, const Vec3& way, HandTimes times) {
  check_times(times);
  return std::make_unique<Reach>(start, way, times);
}

std::unique_ptr<const HandMotion> make_chirp_motion(const Vec3& start, const Vec3& way, HandTimes times,
                                                    double slow, double fast) {
  check_times(times);
  if (!(slow >= 0.0) || !(fast > slow)) throw Error(ErrorKind::kUsage, "a chirp must go from slow to fast");
  return std::make_unique<Chirp>(start, way, times, slow, fast);
}

std::unique_ptr<const HandMotion> make_release_motion(const Vec3& start, const Vec3& way, double time) {
  return std::make_unique<Release>(start, way, time);
}

std::unique_ptr<const HandMotion> make_path_motion(std::vector<Vec3> points, double step) {
  if (points.empty()) throw Error(ErrorKind::kUsage, "a hand's path needs a point");
  if (!(step > 0.0)) throw Error(ErrorKind::kUsage, "the points of a hand's path need time between them");
  return std::make_unique<Path>(std::move(points), step);
}

}  // namespace fuai
