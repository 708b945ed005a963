// Raw tests of the Browzwear Fabric Analyzer (FAB), as U3M 1.1 physics files carry them, in SI.
// SPDX-License-Identifier: Apache-2.0
// Source: "Raw Measurement Data from FAB", version 1.2, Browzwear 2020; schema of github.com/vizoogmbh/u3m.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "fuai/core/types.h"

namespace fuai {

/// The five tests of each strip.
enum class FabTest {
  kS1,  ///< stretch, clamps about 2 cm apart
  kS2,  ///< stretch, clamps about 8 cm apart
  kD1,  ///< bend downwards, clamps about 2 cm apart
  kD2,  ///< bend downwards, clamps about 8 cm apart
  kU1,  ///< bend upwards, clamps about 2 cm apart
};
inline constexpr int kFabTestCount = 5;
constexpr const char* to_string(FabTest test) {
  constexpr const char* kNames[] = {"S1", "S2", "D1", "D2", "U1"};
  return kNames[static_cast<int>(test)];
}

/// One sample: what the two clamps say. Tension is positive; the force is that of the whole strip.
struct FabSample {
  double clamp_distance = 0.0;  ///< [m]
  double force = 0.0;           ///< [N]
};

/// One test of one strip: branches alternate out and back.
struct FabStripTest {
  double width = 0.0;        ///< strip width [m]
  double length = 0.0;       ///< free length of cloth between the clamps [m]
  double sample_rate = 0.0;  ///< [Hz]
  std::vector<std::vector<FabSample>> branches;
};

/// One physics file. FAB's L (length) is the warp, W (width) the weft, B the bias.
struct FabRecord {
  std::string name;
  std::string composition;  ///< "100 % Rayon"
  std::string category;     ///< "Weaves", "Knits"
  double areal_mass = 0.0;  ///< [kg/m2]
  double thickness = 0.0;   ///< [m], 0 when the file has none
  std::array<std::array<FabStripTest, kFabTestCount>, kDirectionCount> strips;  ///< [Direction][FabTest]
  std::vector<std::vector<FabSample>> thickness_branches;  ///< T test, force negative in compression
  std::map<std::string, std::string> vendor_warnings;      ///< e.g. BendRigidityWarp -> low-force
  std::string source;                                      ///< file name, for messages
  std::string source_date;  ///< ISO date of the newest test; empty when unknown

  const FabStripTest& strip(Direction direction, FabTest test) const {
    return strips[static_cast<std::size_t>(direction)][static_cast<std::size_t>(test)];
  }
};

}  // namespace fuai
