// KES-FB1: tension to a load and back to none.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "fuai/core/error.h"
#include "fuai/laboratory/kes_instruments.h"
#include "fuai/laboratory/specimen.h"

namespace fuai {
namespace {

constexpr double kSpacing = 0.01;  ///< h [m]; the strain is the same everywhere
constexpr double kSteps = 100.0;   ///< from zero to the stop
constexpr double kMostStrain = 10.0;
constexpr double kLoadTolerance = 1e-9;  ///< a stop is met to this part of the largest load
constexpr int kRounds = 60;

/// The instrument.
class TensileTester {
 public:
  TensileTester(const FabricLaws& laws, const SpecimenSpec& spec) : specimen_(laws, spec) {}

  /// Goes to a strain without committing. @return whether the cloth came to rest
  bool try_strain(double strain) {
    if (!specimen_.settle(Mat3::Identity(), strain * specimen_.spec().length * specimen_.along()).converged) {
      specimen_.roll_back();
      return false;
    }
    sample_ = {strain, -specimen_.moving().force.dot(specimen_.along()) / specimen_.spec().width};
    return true;
  }
  void commit() { specimen_.commit(); }
  const CurveSample& sample() const { return sample_; }
  int iterations() const { return specimen_.iterations(); }

  /// Between two strains, one on either side of a load, finds the one that carries it.
  void find_load(CurveSample a, CurveSample b, double load, double tolerance) {
    for (int round = 0; round < kRounds && std::abs(sample_.stress - load) > tolerance; ++round) {
      // False position, every third time the middle, so that the bracket shrinks from both ends.
      const double t = round % 3 == 2 ? 0.5 : (load - a.stress) / (b.stress - a.stress);
      if (!try_strain(a.strain + t * (b.strain - a.strain))) break;
      ((sample_.stress - load) * (a.stress - load) > 0.0 ? a : b) = sample_;
    }
  }

 private:
  Specimen specimen_;
  CurveSample sample_;
};

/// One test: the recorder, the tester and where the loads are.
struct TensileTest {
  TensileTester& tester;
  KesRecorder& recorder;
  double step;       // [-]
  double tolerance;  // [N/m]

  /// Steps until the load is passed on the way up (sense 1) or down (-1), or a strain is reached.
  void run(int sense, double load, double strain_limit) {
    recorder.begin(sense > 0 ? Branch::kLoad : Branch::kUnload);
    while (true) {
      const CurveSample before = recorder.last();
      const double limit = sense * (strain_limit - before.strain);
      if (!(limit > 0.0) && std::abs(strain_limit) < kMostStrain) return;
      if (!(limit > 0.0))
        throw Error(ErrorKind::kCheckFailed, "the specimen never carried the load of the stop", {},
                    "check the EMT and LT of the fabric");
      bool at_rest = false;
      double part = 1.0;
      for (; part > 1e-2 && !at_rest; part *= 0.5)
        at_rest = tester.try_strain(before.strain + sense * std::min(part * step, limit));
      if (!at_rest)
        throw Error(ErrorKind::kCheckFailed, "the specimen did not come to rest while it was pulled", {},
                    "take another spacing");
      const bool passed = sense * (tester.sample().stress - load) >= 0.0;
      if (passed) tester.find_load(before, tester.sample(), load, tolerance);
      tester.commit();
      recorder.add(tester.sample());
      if (passed) return;
    }
  }
};

}  // namespace

KesRecord run_kes_tensile(const FabricLaws& laws, const KesOptions& options, const Progress& progress) {
  SpecimenSpec spec;
  spec.along = options.direction;
  spec.length = options.length;
  spec.width = options.width;
  spec.spacing = options.spacing > 0.0 ? options.spacing : kSpacing;
  const bool by_strain = options.stop_strain > 0.0;
  const double load = options.high > 0.0 ? options.high : assumed::kPeakLoad;
  TensileTester tester(laws, spec);
  KesRecorder recorder(CurveSample{});
  // Steps of a hundredth of the way; only their number hangs on this guess, not the result.
  const double way =
      by_strain ? options.stop_strain
                : stretch_under(laws.tensile[static_cast<std::size_t>(options.direction)], load) - 1.0;
  TensileTest test{tester, recorder, way / kSteps, kLoadTolerance * load};
  const double up_to = by_strain ? std::numeric_limits<double>::infinity() : load;
  for (const KesReversal& reversal : options.reversals) {
    test.run(1, up_to, reversal.out);
    test.run(-1, 0.0, reversal.back > 0.0 ? reversal.back : -kMostStrain);
  }
  test.run(1, up_to, by_strain ? options.stop_strain : kMostStrain);
  if (progress) progress("virtual instrument", 0.5);
  test.run(-1, 0.0, -kMostStrain);
  KesRecord record;
  record.curve = recorder.take(Test::kTensile, options.direction);
  record.spacing = spec.spacing;
  record.iterations = tester.iterations();
  return record;
}

}  // namespace fuai
