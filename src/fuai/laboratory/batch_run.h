// Runs the cases of a batch as processes and keeps what each left behind.
// SPDX-License-Identifier: Apache-2.0
//
//   folder/cases/<id>.json   one a case, written whole as it ends: what exists is finished
//   folder/files/<id>/       what its command writes
//   folder/results.csv, results.json   of all cases, in the order of the manifest, at the end
//
// A run that was killed is repeated with the same words: finished cases are kept, the others start anew.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/io/case_record.h"
#include "fuai/laboratory/batch_cases.h"

namespace fuai {

/// How a batch is run.
struct BatchOptions {
  std::string folder;
  std::string program;  ///< path of the program whose command lines the cases are
  std::string version;  ///< of it; what another version made is made again
  int jobs = 0;         ///< processes at a time; 0: as many as the machine has cores
  bool retry = false;   ///< cases that failed are run again
};

/// What came of it.
struct BatchOutcome {
  std::vector<CaseRecord> records;  ///< in the order of the cases
  int kept = 0, ran = 0;
  int failed() const noexcept;
};

/// Whether a record, as it was read, spares running a case: it is of the same case, version, command line
/// and fabric, and ended by itself, not for want of a device. With `retry` also without failing. Thread
/// class: any.
bool is_finished(const CaseRecord& record, const BatchCase& batch_case, const BatchOptions& options) noexcept;

/// The record of a case on the disk, when it is finished. @throws nothing for a file that cannot be read.
std::optional<CaseRecord> read_finished(const BatchCase& batch_case, const BatchOptions& options);

/// Runs what is not finished. A case that fails is recorded and the others go on.
/// @param on_case called with every case that has just ended; may be empty
/// @throws Error (kBadInput) when the folder cannot be written, (kCheckFailed) when no process can be
/// started. Thread class: set-up.
BatchOutcome run_batch(std::span<const BatchCase> cases, const BatchOptions& options,
                       const Progress& progress = {},
                       const std::function<void(const CaseRecord&)>& on_case = {});

/// Writes results.csv and results.json. @param manifest its path. @return their paths. @throws Error
/// (kBadInput). Thread class: set-up.
std::vector<std::string> write_batch_results(const BatchOutcome& outcome, const std::string& folder,
                                             const std::string& manifest);

/// "40 s", "3 min", "2 h 10 min". @param seconds not negative. Thread class: any.
std::string duration_text(double seconds);

}  // namespace fuai
