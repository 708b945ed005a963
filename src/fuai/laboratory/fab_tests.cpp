// Buckles and stretches strips.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fab_tests.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "fuai/core/constants.h"
#include "fuai/core/error.h"
#include "fuai/laboratory/specimen.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

constexpr double kStripWidth = 0.05;                     ///< [m]
constexpr double kShortStrip = 0.02, kLongStrip = 0.08;  ///< free lengths [m]
constexpr double kSimulatedSpacings = 4.0;               ///< of the strip's width
/// Clamp distances where the motion turns [free lengths], as in the records of both bundled fabrics.
constexpr std::array<double, 7> kTurns{0.93, 0.835, 0.93, 0.715, 0.93, 0.595, 0.93};
constexpr double kSampleStep = 0.0168;     ///< [free lengths]
constexpr double kFirstShortening = 2e-4;  ///< where the flat strip is made to buckle [free lengths]
constexpr int kVirginSteps = 12;           ///< from there to the first turn, and of the clamps' tilt
constexpr std::array<double, 4> kStretchLoads{25.0, 50.0, 75.0, 100.0};  ///< [gf/cm]

/// Yarns that neither stretch nor shorten to speak of: of the forces of a buckled strip, some gf/cm, they
/// take 1e-5 of strain. With the fabric's own a short strip would rather shorten than buckle.
PlayLaw stiff_yarns(const PlayLaw& law) {
  constexpr double kStiffness = 1e5;  // [N/m]
  const std::array<double, 2> stress{-kStiffness, kStiffness}, none{0.0, 0.0};
  return make_play_law(make_curve_table(-1.0, 1.0, stress), make_curve_table(-1.0, 1.0, none),
                       law.elements());
}

/// The strip in the machine, seen from the fixed clamp: when both are tilted, the line between them and the
/// weight turn the other way.
class BucklingTester {
 public:
  BucklingTester(const FabricLaws& laws, const SpecimenSpec& spec, bool upwards)
      : specimen_(laws, spec), upwards_(upwards) {}

  /// From flat to the first shortening in the sense of the test, then to a distance in equal steps of the
  /// amplitude, which goes with the root of the shortening.
  void buckle(double distance) {
    const double L = specimen_.spec().length, first = 1.0 - distance / L;
    const double start = std::min(kFirstShortening, first);
    // First mode: height A (1 - cos(2 pi s)) / 2, shortening (pi A / (2 L))^2.
    const double A = 2.0 * L * std::sqrt(start) / std::numbers::pi * (upwards_ ? 1.0 : -1.0);
    specimen_.raise([A](double s) { return 0.5 * A * (1.0 - std::cos(2.0 * std::numbers::pi * s)); });
    for (int k = 0; k <= kVirginSteps; ++k) {
      const double root = std::sqrt(start) + (std::sqrt(first) - std::sqrt(start)) * k / kVirginSteps;
      go(L * (1.0 - root * root));
    }
  }
  void tilt(double angle) {
    for (int k = 1; angle != 0.0 && k <= kVirginSteps; ++k) {
      tilt_ = angle * k / kVirginSteps;
      go(distance_);
    }
  }
  /// @throws Error (kCheckFailed)
  void go(double distance) {
    CurveSample unused;
    const double from = distance_ > 0.0 ? distance_ : specimen_.spec().length;
    move_in_parts(
        from, distance, [this](double d, CurveSample&) { return try_distance(d); }, unused);
  }
  /// On the moving clamp, tension positive, of a strip of the machine's width [N].
  double force() const {
    return -specimen_.moving().force.dot(level()) * kStripWidth / specimen_.spec().width;
  }

 private:
  bool try_distance(double distance) {
    // The moving clamp looks back along the strip: it tilts up by turning the other way round.
    const Vec3 shift = distance * level() - specimen_.spec().length * specimen_.along();
    specimen_.set_gravity(turned(-tilt_) * specimen_.spec().gravity);
    if (!specimen_.settle(turned(-2.0 * tilt_), shift).converged) {
      specimen_.roll_back();
      return false;
    }
    specimen_.commit();
    distance_ = distance;
    return true;
  }

  /// Turned upwards by an angle.
  Mat3 turned(double angle) const {
    return Eigen::AngleAxisd(angle, specimen_.bend_axis()).toRotationMatrix();
  }
  /// From clamp to clamp.
  Vec3 level() const { return turned(-tilt_) * specimen_.along(); }

  Specimen specimen_;
  bool upwards_;
  double distance_ = 0.0, tilt_ = 0.0;
};

}  // namespace

FabStripTest run_fab_buckling(const FabricLaws& laws, const FabBucklingOptions& options,
                              const Progress& progress) {
  if (options.test == FabTest::kS1 || options.test == FabTest::kS2 || options.segments < 8)
    throw Error(ErrorKind::kUsage, "a buckling test is D1, U1 or D2, with at least eight segments");
  FabricLaws stiff = laws;
  for (PlayLaw& law : stiff.tensile) law = stiff_yarns(law);
  SpecimenSpec spec;
  spec.along = options.direction;
  spec.length = options.test == FabTest::kD2 ? kLongStrip : kShortStrip;
  spec.spacing = spec.length / options.segments;
  spec.width = kSimulatedSpacings * spec.spacing;
  spec.bends = true;
  spec.gravity = Vec3(0.0, 0.0, -kStandardGravity);
  FabStripTest test;
  test.width = kStripWidth;
  test.length = spec.length;
  BucklingTester tester(stiff, spec, options.test == FabTest::kU1);
  tester.buckle(kTurns[0] * spec.length);
  tester.tilt(options.clamp_tilt);
  double at = kTurns[0];
  for (std::size_t k = 1; k < kTurns.size(); ++k) {
    const int count = std::max(1, static_cast<int>(std::round(std::abs(kTurns[k] - at) / kSampleStep)));
    std::vector<FabSample> branch;
    for (int i = k == 1 ? 0 : 1; i <= count; ++i) {
      const double distance = spec.length * (at + (kTurns[k] - at) * i / count);
      tester.go(distance);
      branch.push_back({distance, tester.force()});
    }
    test.branches.push_back(std::move(branch));
    at = kTurns[k];
    if (progress) progress("buckling", static_cast<double>(k) / (kTurns.size() - 1));
  }
  return test;
}

FabRecord record_fab_buckling(const FabricLaws& laws, Direction direction, const Progress& progress) {
  FabRecord record;
  record.areal_mass = laws.areal_mass;
  record.source = "virtual Fabric Analyzer";
  for (FabTest test : {FabTest::kD1, FabTest::kU1}) {
    FabBucklingOptions options;
    options.direction = direction;
    options.test = test;
    record.strips[static_cast<std::size_t>(direction)][static_cast<std::size_t>(test)] =
        run_fab_buckling(laws, options, progress);
  }
  return record;
}

MeasuredCurve run_fab_stretch(const FabricLaws& laws, Direction direction, std::span<const double> turns) {
  const PlayLaw& yarns = laws.tensile[static_cast<std::size_t>(direction == Direction::kWeft)];
  std::vector<double> strains(turns.begin(), turns.end());
  if (strains.empty()) {
    for (double load : kStretchLoads) strains.push_back(stretch_under(yarns, load * unit::kGfPerCm) - 1.0);
  }
  KesOptions options;
  options.direction = direction;
  options.width = kStripWidth;
  options.length = kLongStrip;
  for (double strain : strains) options.reversals.push_back({strain, 0.0});
  options.stop_strain = strains.back();
  options.reversals.pop_back();
  return run_kes_tensile(laws, options).curve;
}

}  // namespace fuai
