// The report: one self-contained page about a fabric or a comparison, from which a colleague can repeat it.
// SPDX-License-Identifier: Apache-2.0
//
//   fabrics -> numbers, laws -> drape test -> virtual KES instruments -> page: results, pictures, method,
//   settings, seeds, version, sources, commands
//
// The page holds no date and no time that a run took: the same words give the same page.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/laboratory/fabric_comparison.h"
#include "fuai/laboratory/fabric_study.h"
#include "fuai/laboratory/kes_round_trip.h"

namespace fuai {

/// The round trips of a report unless others are asked for: bending and tension of both yarn directions, and
/// shear as their mean. Thread class: any.
std::vector<KesTest> report_kes_tests();

/// What to do, and what the page says of it.
struct ReportOptions {
  DrapeTestOptions drape;                         ///< its threads are those of everything
  std::vector<KesTest> kes = report_kes_tests();  ///< may be empty
  std::string version;                            ///< of the program
  std::vector<std::string> names;                 ///< of the fabrics as the user wrote them
  std::string output;                             ///< the page's file, as the user wrote it
};

/// A round trip, or why there is none.
struct ReportedTest {
  KesTest test;
  std::optional<KesRoundTrip> trip;
  std::string failure;  ///< the instrument's words when its cloth did not come to rest
};

struct ReportedFabric {
  FabricStudy study;
  std::vector<ReportedTest> kes;
  std::string hash;  ///< fabric_hash()
};

struct FabricReport {
  std::vector<ReportedFabric> fabrics;
  std::optional<FabricComparison> comparison;  ///< of two fabrics and more

  bool at_rest() const noexcept;  ///< every specimen, and every round trip came to its end
};

/// Sixteen digits over everything that stands in a fabric's file and its curves: the same digits, the same
/// input. Thread class: set-up.
std::string fabric_hash(const Fabric& fabric);

/// Runs everything. @throws Error (kUsage) unless there are one to six fabrics; as run_fabric_study() and
/// run_kes_round_trip(), but for tests that do not come to their end. Thread class: set-up.
FabricReport run_fabric_report(std::span<const Fabric> fabrics, const ReportOptions& options,
                               const Progress& progress = {});

/// The page. @param pictures of each fabric. @throws Error (kNoDevice) when built without pictures. Thread
/// class: set-up.
std::string report_html(const FabricReport& report, const ReportOptions& options,
                        std::span<const StudyPictures> pictures);

/// The command lines that repeat it, one a line. Thread class: any.
std::string repeating_commands(const ReportOptions& options);

}  // namespace fuai
