// The whole round trip: every bundled fabric and 200 random plausible ones through the virtual KES
// instruments, at their own spacings.
// SPDX-License-Identifier: Apache-2.0
//
//   bench_round_trip [COUNT [FIRST]]   random fabrics, seeds from FIRST on; families take turns
//
// One line a test: fabric, test, direction, loop rms [%], largest parameter error [%], edge share [%], Newton
// iterations, CPU time [s]. Then the worst of each test. docs/laboratory.md has the figures.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <string>

#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/kes_round_trip.h"
#include "fuai/runtime/thread_clock.h"
#include "support/random_fabric.h"

namespace {

using namespace fuai;

/// The worst of one test.
struct Worst {
  double rms = 0.0, parameter = 0.0, seconds = 0.0;
  int runs = 0, failures = 0;
};

class Sweep {
 public:
  void run(const Fabric& fabric) {
    one(fabric, {Test::kBending, Direction::kWarp, {}, 0.0});
    one(fabric, {Test::kBending, Direction::kWeft, {}, 0.0});
    one(fabric, {Test::kShear, {}, {}, 0.0});
    one(fabric, {Test::kTensile, Direction::kWarp, {}, 0.0});
    one(fabric, {Test::kTensile, Direction::kWeft, {}, 0.0});
  }
  void summary(const char* title) {
    std::printf("# %s\n# test      runs  failures  worst rms %%  worst parameter %%  longest s\n", title);
    for (const auto& [test, w] : worst_)
      std::printf("# %-8s %5d %9d %12.4f %18.4f %10.2f\n", test.c_str(), w.runs, w.failures, w.rms,
                  w.parameter, w.seconds);
    worst_.clear();
  }

 private:
  void one(const Fabric& fabric, const KesTest& test) {
    Worst& worst = worst_[to_string(test.test)];
    const char* direction = test.direction ? to_string(*test.direction) : "mean";
    ++worst.runs;
    try {
      const double start = thread_seconds();
      const KesRoundTrip trip = run_kes_round_trip(fabric, test);
      const double seconds = thread_seconds() - start;
      double parameter = 0.0;
      for (std::size_t i = 0; i < trip.input.size(); ++i) {
        const double own = trip.input[i].value, simulated = trip.simulated[i].value;
        if (own != simulated) parameter = std::max(parameter, 100.0 * std::abs(simulated / own - 1.0));
      }
      const double rms = 100.0 * trip.loop_rms;
      std::printf("%s,%s,%s,%.4f,%.4f,%.2f,%d,%.2f\n", fabric.id.c_str(), to_string(test.test), direction,
                  rms, parameter, 100.0 * trip.record.edge_share, trip.record.iterations, seconds);
      worst.rms = std::max(worst.rms, rms);
      worst.parameter = std::max(worst.parameter, parameter);
      worst.seconds = std::max(worst.seconds, seconds);
    } catch (const Error& error) {
      ++worst.failures;
      std::printf("%s,%s,%s,failed: %s\n", fabric.id.c_str(), to_string(test.test), direction, error.what());
    }
    std::fflush(stdout);
  }

  std::map<std::string, Worst> worst_;
};

}  // namespace

int main(int argc, char** argv) {
  const int count = argc > 1 ? std::atoi(argv[1]) : 200, first = argc > 2 ? std::atoi(argv[2]) : 0;
  Sweep sweep;
  std::printf("fabric,test,direction,rms_percent,parameter_percent,edge_share_percent,iterations,seconds\n");
  for (const std::string& id : bundled_fabric_ids()) sweep.run(load_fabric(id));
  sweep.summary("bundled fabrics");
  for (int seed = first; seed < first + count; ++seed) {
    sweep.run(fuai_test::random_fabric(static_cast<std::uint64_t>(seed),
                                       static_cast<std::size_t>(seed) % fuai_test::kAnything));
  }
  sweep.summary("random fabrics of five families");
  for (int seed = first; seed < first + count / 5; ++seed)
    sweep.run(fuai_test::random_fabric(static_cast<std::uint64_t>(seed), fuai_test::kAnything));
  sweep.summary("random fabrics whose numbers need not fit together");
  return 0;
}
