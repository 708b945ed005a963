// Writes forces row by row.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/force_log.h"

#include "fuai/io/delimited.h"
#include "fuai/io/number_text.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// Forces and places are computed in single precision.
constexpr int kDigits = 7;

std::string row(const ViewSnapshot& snapshot, std::size_t cloth, const std::string& fabric,
                const std::string& hand, const GraspReading& reading) {
  std::vector<std::string> cells{brief_number(snapshot.time, kDigits), std::to_string(cloth + 1), fabric,
                                 hand};
  for (int i = 0; i < 3; ++i) cells.push_back(brief_number(reading.centre[i], kDigits));
  for (int i = 0; i < 3; ++i) cells.push_back(brief_number(reading.force[i], kDigits));
  cells.push_back(brief_number(reading.force.norm(), kDigits));
  cells.push_back(brief_number(reading.force.norm() / unit::kGramForce, kDigits));
  cells.emplace_back(reading.saturated ? "1" : "0");
  return csv_row(cells);
}

}  // namespace

ForceLog::ForceLog(const std::string& path) : file_(path) {
  file_.add("time_s,cloth,fabric,hand,x_m,y_m,z_m,fx_N,fy_N,fz_N,force_N,force_gf,slips\n");
}

void ForceLog::write(const ViewSnapshot& snapshot, const std::vector<std::string>& fabrics) {
  if (snapshot.tick == tick_ && snapshot.build == build_) return;
  tick_ = snapshot.tick;
  build_ = snapshot.build;
  std::string rows;
  for (std::size_t c = 0; c < snapshot.cloths.size(); ++c) {
    const ClothView& cloth = snapshot.cloths[c];
    const std::string fabric = c < fabrics.size() ? fabrics[c] : "";
    for (std::size_t h = 0; h < kMostViewHands; ++h)
      if (cloth.hands[h].holds) rows += row(snapshot, c, fabric, std::to_string(h), cloth.hands[h]);
    for (std::size_t h = 0; h < kMostHands; ++h)
      if (cloth.scene_hands[h].holds)
        rows += row(snapshot, c, fabric, "scene " + std::to_string(h), cloth.scene_hands[h]);
  }
  if (!rows.empty()) file_.add(rows);
}

}  // namespace fuai
