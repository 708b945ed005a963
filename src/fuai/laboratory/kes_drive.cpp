// Splits the path into steps and branches.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/kes_drive.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/core/error.h"

namespace fuai {

std::vector<double> turning_points(std::span<const KesReversal> reversals, std::span<const double> stops) {
  std::vector<double> turns;
  for (const KesReversal& r : reversals) turns.insert(turns.end(), {r.out, r.back});
  turns.insert(turns.end(), stops.begin(), stops.end());
  return turns;
}

void move_in_parts(double from, double to, const KesMove& move, CurveSample& sample, int halvings) {
  if (move(to, sample)) return;
  if (halvings == 0) {
    throw Error(ErrorKind::kCheckFailed, "the specimen did not come to rest at " + std::to_string(to), {},
                "take another spacing");
  }
  const double middle = 0.5 * (from + to);
  move_in_parts(from, middle, move, sample, halvings - 1);
  move_in_parts(middle, to, move, sample, halvings - 1);
}

void drive(std::span<const double> turns, double step, const KesMove& move, KesRecorder& recorder,
           const Progress& progress) {
  // Legs that do not cross zero: beyond it the cloth is loaded the other way.
  std::vector<double> ends;
  double at = recorder.last().strain, whole = 0.0, gone = 0.0;
  for (double turn : turns) {
    if (at * turn < 0.0) ends.push_back(0.0);
    if (turn != at) ends.push_back(turn);
    whole += std::abs(turn - at);
    at = turn;
  }
  at = recorder.last().strain;
  for (double end : ends) {
    recorder.begin(std::abs(end) > std::abs(at) ? Branch::kLoad : Branch::kUnload);
    // 1e-9: a leg of exactly so many steps has so many, whatever the rounding.
    const int count = std::max(1, static_cast<int>(std::ceil(std::abs(end - at) / step - 1e-9)));
    double from = at;
    for (int i = 1; i <= count; ++i) {
      const double to = i == count ? end : at + (end - at) * i / count;
      CurveSample sample;
      move_in_parts(from, to, move, sample);
      recorder.add(sample);
      gone += std::abs(to - from);
      from = to;
      if (progress) progress("virtual instrument", gone / whole);
    }
    at = end;
  }
}

}  // namespace fuai
