// The rules that fill gaps of a bending measurement.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/bending_rules.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "fuai/fabric/assumptions.h"

namespace fuai {

HysteresisRule hysteresis_rule(const Fabric& fabric) {
  const auto made_of = [&](std::initializer_list<const char*> fibres) {
    return std::ranges::any_of(
        fibres, [&](const char* f) { return fabric.composition.find(f) != std::string::npos; });
  };
  if (made_of({"otton", "inen", "lax", "綿", "麻"})) {
    return {assumed::kHysteresisPerBendingCotton,
            "2HB was not measured: taken as 1.0 /cm times B (cotton, linen)"};
  }
  if (made_of(
          {"ool", "ilk", "olyester", "olyamide", "ylon", "ayon", "iscose", "upro", "cetate", "毛", "絹"})) {
    return {assumed::kHysteresisPerBendingSmooth,
            "2HB was not measured: taken as 0.45 /cm times B (wool, filament)"};
  }
  return {assumed::kHysteresisPerBendingUnknown,
          "2HB was not measured: taken as 0.7 /cm times B (fibre not stated)"};
}

double bias_of(double warp, double weft, double twist_share) noexcept {
  return 0.25 * (warp + weft + 4.0 * twist_share * std::sqrt(warp * weft));
}

}  // namespace fuai
