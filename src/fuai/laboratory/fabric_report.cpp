// Runs what a report needs.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_report.h"

#include <algorithm>
#include <functional>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_file.h"
#include "fuai/runtime/parallel.h"
#include "fuai/runtime/shared_progress.h"

namespace fuai {
namespace {

using Index = std::size_t;

/// The drape tests are this part of the whole, as far as progress goes.
constexpr double kDrapeShare = 0.5;

void run_test(const Fabric& fabric, ReportedTest& reported, const Progress& progress) {
  try {
    reported.trip = run_kes_round_trip(fabric, reported.test, progress);
  } catch (const Error& e) {
    if (e.kind() != ErrorKind::kCheckFailed) throw;
    reported.failure = e.what();
  }
}

void run_kes_tests(FabricReport& report, const ReportOptions& options, const Progress& progress) {
  SharedProgress shared(progress, report.fabrics.size() * options.kes.size());
  std::vector<std::function<void()>> tasks;
  for (ReportedFabric& fabric : report.fabrics) {
    for (const KesTest& test : options.kes) fabric.kes.push_back({test, {}, {}});
    for (ReportedTest& reported : fabric.kes) {
      const Progress own = shared.of(tasks.size(), "virtual KES");
      tasks.emplace_back([&fabric, &reported, own] {
        run_test(fabric.study.fabric, reported, own);
        if (own) own("", 1.0);
      });
    }
  }
  run_parallel(tasks, options.drape.threads);
}

}  // namespace

std::vector<KesTest> report_kes_tests() {
  std::vector<KesTest> tests(5);
  tests[0].direction = tests[3].direction = Direction::kWarp;
  tests[1].direction = tests[4].direction = Direction::kWeft;
  tests[2].test = Test::kShear;
  tests[3].test = tests[4].test = Test::kTensile;
  return tests;
}

bool FabricReport::at_rest() const noexcept {
  return std::ranges::all_of(fabrics, [](const ReportedFabric& fabric) {
    return fabric.study.drape.at_rest() &&
           std::ranges::all_of(fabric.kes, [](const ReportedTest& test) { return test.trip.has_value(); });
  });
}

std::string fabric_hash(const Fabric& fabric) {
  const std::string text = format_fabric(fabric);
  StateHash hash;
  hash.add(text.data(), text.size());
  Fabric copy = fabric;
  for (const FabricCurveField& field : fabric_curve_fields(copy)) {
    if (!*field.curve) continue;
    for (const CurveBranch& branch : (*field.curve)->curve.branches) {
      for (const CurveSample& sample : branch.samples) hash.add(sample.strain), hash.add(sample.stress);
    }
  }
  return hash.hex();
}

FabricReport run_fabric_report(std::span<const Fabric> fabrics, const ReportOptions& options,
                               const Progress& progress) {
  if (fabrics.size() != 1) check_compared_count(fabrics.size());
  FabricReport report;
  if (fabrics.size() > 1) report.comparison = compare_fabrics(fabrics, bundled_thresholds());
  const double share = options.kes.empty() ? 1.0 : kDrapeShare;
  for (Index i = 0; i < fabrics.size(); ++i) {
    const auto shown = [&](std::string_view what, double fraction) {
      progress(what, share * (static_cast<double>(i) + fraction) / static_cast<double>(fabrics.size()));
    };
    report.fabrics.push_back(
        {run_fabric_study(fabrics[i], options.drape, progress ? Progress(shown) : Progress()),
         {},
         fabric_hash(fabrics[i])});
  }
  const Progress rest = progress ? Progress([&](std::string_view what, double fraction) {
    progress(what, share + (1.0 - share) * fraction);
  })
                                 : Progress();
  run_kes_tests(report, options, rest);
  return report;
}

}  // namespace fuai
