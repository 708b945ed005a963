// A measured curve: samples of one test in one direction, branch by branch, as a laboratory records them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/core/types.h"

namespace fuai {

/// The instrument tests whose curves fuai reads.
enum class Test { kBending, kShear, kTensile, kCompression };

constexpr const char* to_string(Test test) {
  constexpr const char* kNames[] = {"bending", "shear", "tensile", "compression"};
  return kNames[static_cast<int>(test)];
}

/// Whether the instrument drives the strain away from, or back towards, where the branch began.
enum class Branch { kLoad, kUnload };

/// One sample. Units by test:
///   bending      strain = curvature [1/m],     stress = moment per width [N]
///   shear        strain = shear angle [rad],   stress = force per width [N/m]
///   tensile      strain = elongation [-],      stress = force per width [N/m]
///   compression  strain = thickness loss [m],  stress = pressure [Pa]
struct CurveSample {
  double strain = 0.0;
  double stress = 0.0;
};

/// Consecutive samples in one sense of motion.
struct CurveBranch {
  Branch kind = Branch::kLoad;
  std::vector<CurveSample> samples;  ///< in the order measured, at least two
};

/// Whether the strain grows from the first sample to the last.
inline bool rises(const CurveBranch& branch) {
  return branch.samples.back().strain > branch.samples.front().strain;
}

/// A whole recording: branches in the order measured, any number of cycles.
struct MeasuredCurve {
  Test test = Test::kBending;
  Direction direction = Direction::kWarp;
  std::vector<CurveBranch> branches;
  std::string source;  ///< file it came from, for messages
};

}  // namespace fuai
