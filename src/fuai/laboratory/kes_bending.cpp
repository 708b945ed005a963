// KES-FB2: pure bending.
// SPDX-License-Identifier: Apache-2.0
#include <Eigen/Geometry>
#include <array>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/laboratory/kes_instruments.h"
#include "fuai/laboratory/specimen.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

constexpr double kLength = 0.01;    ///< between the clamps [m]
constexpr double kSpacing = 0.002;  ///< h [m]; the lattice bends exactly at any spacing
constexpr double kSteps = 50.0;     ///< from zero to the stop: 0.05 1/cm over the KES range
constexpr double kSharpest = 3.0;   ///< largest angle between the clamps [rad]: beyond, they would touch

}  // namespace

KesRecord run_kes_bending(const FabricLaws& laws, const KesOptions& options, const Progress& progress) {
  SpecimenSpec spec;
  spec.along = options.direction;
  spec.length = kLength;
  spec.width = options.width;
  spec.spacing = options.spacing > 0.0 ? options.spacing : kSpacing;
  spec.bends = true;
  const double high = options.high > 0.0 ? options.high : kKesBendingRange;
  const double low = options.high > 0.0 ? options.low : -kKesBendingRange;
  if (!(low <= 0.0) || !(std::max(high, -low) * kLength < kSharpest))
    throw Error(ErrorKind::kUsage, "a bending test goes from 0 to a curvature of at most 3 1/cm either way");
  Specimen specimen(laws, spec);
  specimen.pull(specimen.along(), 0.0);
  specimen.pull(Vec3::UnitZ(), 0.0);
  double angle = 0.0;
  const KesMove move = [&](double curvature, CurveSample& sample) {
    const Mat3 turn = Eigen::AngleAxisd(curvature * kLength, specimen.bend_axis()).toRotationMatrix();
    if (!specimen.settle_turned(turn, curvature * kLength - angle).converged) {
      specimen.roll_back();
      return false;
    }
    specimen.commit();
    angle = curvature * kLength;
    sample = {curvature, -specimen.moving().moment.dot(specimen.bend_axis()) / spec.width};
    return true;
  };
  const std::array<double, 3> stops{high, low, 0.0};
  const double step = std::max(high, -low) / kSteps;
  if (options.conditioned) {
    KesRecorder unrecorded(CurveSample{});
    drive(stops, step, move, unrecorded);
  }
  CurveSample start;
  move_in_parts(0.0, 0.0, move, start);
  KesRecorder recorder(start);
  drive(turning_points(options.reversals, stops), step, move, recorder, progress);
  KesRecord record;
  record.curve = recorder.take(Test::kBending, options.direction);
  record.spacing = spec.spacing;
  record.iterations = specimen.iterations();
  return record;
}

}  // namespace fuai
