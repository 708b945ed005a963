// Plausible fabrics by chance: KES scalars drawn over the orders of magnitude of real cloth.
// SPDX-License-Identifier: Apache-2.0
//
// Silk, shirting, suiting, denim and jersey have ranges of their own, warp and weft are drawn apart. They are
// orders of magnitude for tests, not data. `anything` draws each number over all families, so that they need
// not fit together.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>

#include "fuai/fabric/fabric.h"
#include "fuai/units/constants.h"

namespace fuai_test {

struct KesRange {
  double low, high;
};

/// In KES units.
struct FabricFamily {
  const char* name;
  KesRange W, T, EMT, LT, RT, B, twice_HB, G, twice_HG, twice_HG5;
};

inline constexpr std::array<FabricFamily, 6> kFamilies{{
    {"silk",
     {4, 12},
     {.1, .4},
     {2, 6},
     {.5, .9},
     {50, 80},
     {.003, .06},
     {.002, .04},
     {.2, .6},
     {.05, .6},
     {.2, 2}},
    {"shirting",
     {9, 15},
     {.25, .6},
     {2, 8},
     {.6, .95},
     {35, 60},
     {.03, .15},
     {.03, .15},
     {.6, 3},
     {1, 6},
     {2, 9}},
    {"suiting",
     {14, 30},
     {.35, .9},
     {3, 18},
     {.5, .7},
     {55, 80},
     {.05, .25},
     {.02, .15},
     {.4, 1.2},
     {.4, 2},
     {.8, 4}},
    {"denim", {30, 50}, {.7, 1.3}, {2, 8}, {.7, 1.0}, {35, 55}, {.3, 2}, {.3, 2}, {2, 7}, {4, 15}, {6, 20}},
    {"jersey",
     {12, 25},
     {.5, 1.5},
     {10, 60},
     {.5, 1.1},
     {25, 60},
     {.005, .06},
     {.005, .08},
     {.3, 1.2},
     {1, 4},
     {1, 5}},
    {"anything",
     {4, 50},
     {.1, 1.5},
     {2, 60},
     {.5, 1.1},
     {25, 80},
     {.003, 2},
     {.002, 2},
     {.2, 7},
     {.05, 15},
     {.2, 20}},
}};
inline constexpr std::size_t kAnything = 5;

/// A fabric of a family; the same seed, the same fabric.
inline fuai::Fabric random_fabric(std::uint64_t seed, std::size_t family) {
  using namespace fuai;
  std::mt19937_64 random(seed);
  const FabricFamily& f = kFamilies[family];
  // Evenly on a logarithmic scale, and the same on every machine.
  const auto draw = [&](const KesRange& range, double to_si) {
    const double share = static_cast<double>(random() >> 11U) * 0x1p-53;
    return Known{range.low * std::pow(range.high / range.low, share) * to_si,
                 {ProvenanceKind::kMeasured, "drawn", ""}};
  };
  Fabric fabric;
  fabric.id = fabric.name = f.name + std::string("-") + std::to_string(seed);
  fabric.areal_mass = draw(f.W, unit::kMgPerCm2);
  fabric.thickness = draw(f.T, unit::kMillimetre);
  for (std::size_t i = 0; i < 2; ++i) {
    fabric.bending[i].B = draw(f.B, unit::kGfCm2PerCm);
    fabric.bending[i].hysteresis_2HB = draw(f.twice_HB, unit::kGfCmPerCm);
    TensileMeasurement& t = fabric.tensile[i];
    t.LT = draw(f.LT, 1.0);
    t.RT = draw(f.RT, unit::kPercent);
    t.EMT = draw(f.EMT, unit::kPercent);
    t.peak_load = {500.0 * unit::kGfPerCm, {ProvenanceKind::kAssumed, "drawn", ""}};
    t.WT = {0.5 * t.LT.value * t.EMT.value * t.peak_load.value, {ProvenanceKind::kComputed, "drawn", ""}};
  }
  fabric.shear.G = draw(f.G, unit::kGfPerCmDeg);
  fabric.shear.hysteresis_2HG = draw(f.twice_HG, unit::kGfPerCm);
  fabric.shear.hysteresis_2HG5 = draw(f.twice_HG5, unit::kGfPerCm);
  return fabric;
}

}  // namespace fuai_test
