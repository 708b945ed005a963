// Runs the cases of a batch as processes and keeps what each left behind.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/batch_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <thread>

#include "fuai/core/error.h"
#include "fuai/io/folder_lock.h"
#include "fuai/io/text_file.h"
#include "fuai/runtime/processes.h"

namespace fuai {
namespace {

namespace fs = std::filesystem;

constexpr int kNoDevice = 4;  ///< exit code: another machine may do better

std::string case_path(const std::string& folder, const std::string& id) {
  return (fs::path(folder) / "cases" / (id + ".json")).string();
}

CaseRecord record_of(const BatchCase& one, const std::string& version, ProcessEnd end) {
  CaseRecord record;
  record.id = one.id;
  record.version = version;
  record.words = one.words;
  record.input_hash = one.input_hash;
  record.settings = one.settings;
  record.exit_code = end.exit_code;
  record.signal = end.signal;
  record.seconds = end.seconds;
  record.messages = std::move(end.messages);
  if (is_json_object(end.output)) {
    record.result = std::move(end.output);
  } else if (end.exit_code == 0) {
    record.messages += "fuai: the program ended well without one JSON object on standard output\n";
  }
  return record;
}

/// Says how far the batch is and how long it may take.
class Clock {
 public:
  Clock(const Progress& progress, std::size_t kept, std::size_t to_run)
      : progress_(progress), kept_(kept), to_run_(to_run) {}

  void one_ended(bool failed) {
    ++ended_;
    failed_ += failed ? 1 : 0;
  }

  void show() const {
    if (!progress_) return;
    const std::size_t done = kept_ + ended_, all = kept_ + to_run_;
    std::string text = std::to_string(done) + " of " + std::to_string(all) + " cases";
    if (failed_ > 0) text += ", " + std::to_string(failed_) + " failed";
    if (ended_ > 0 && ended_ < to_run_) {
      const double spent = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
      const double left = spent * static_cast<double>(to_run_ - ended_) / static_cast<double>(ended_);
      text += ", about " + duration_text(left) + " left";
    }
    progress_(text, all == 0 ? 1.0 : static_cast<double>(done) / static_cast<double>(all));
  }

 private:
  const Progress& progress_;
  std::size_t kept_, to_run_, ended_ = 0, failed_ = 0;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace

int BatchOutcome::failed() const noexcept {
  return static_cast<int>(std::ranges::count_if(records, [](const CaseRecord& r) { return r.failed(); }));
}

bool is_finished(const CaseRecord& record, const BatchCase& batch_case,
                 const BatchOptions& options) noexcept {
  return record.id == batch_case.id && record.version == options.version &&
         record.words == batch_case.words && record.input_hash == batch_case.input_hash &&
         record.signal == 0 && record.exit_code != kNoDevice && !(options.retry && record.failed());
}

std::optional<CaseRecord> read_finished(const BatchCase& batch_case, const BatchOptions& options) {
  const std::string path = case_path(options.folder, batch_case.id);
  std::error_code code;
  if (!fs::exists(path, code)) return std::nullopt;
  try {
    std::optional<CaseRecord> record = parse_case(read_bytes(path));
    if (record && is_finished(*record, batch_case, options)) return record;
  } catch (const Error&) {  // empty or unreadable: not finished
  }
  return std::nullopt;
}

BatchOutcome run_batch(std::span<const BatchCase> cases, const BatchOptions& options,
                       const Progress& progress, const std::function<void(const CaseRecord&)>& on_case) {
  make_folder((fs::path(options.folder) / "cases").string());
  // 1. What is there already.
  BatchOutcome outcome;
  outcome.records.resize(cases.size());
  std::vector<std::size_t> to_run;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (std::optional<CaseRecord> record = read_finished(cases[i], options)) {
      outcome.records[i] = std::move(*record);
      ++outcome.kept;
    } else {
      to_run.push_back(i);
    }
  }
  // 2. The rest.
  std::vector<ProcessWords> commands;
  for (const std::size_t i : to_run) {
    if (!cases[i].file_folder.empty()) make_folder(cases[i].file_folder);
    ProcessWords& words = commands.emplace_back(ProcessWords{options.program});
    words.insert(words.end(), cases[i].line.begin(), cases[i].line.end());
  }
  Clock clock(progress, static_cast<std::size_t>(outcome.kept), to_run.size());
  const auto on_end = [&](ProcessEnd&& end) {
    const std::size_t i = to_run[end.index];
    outcome.records[i] = record_of(cases[i], options.version, std::move(end));
    write_atomically(case_path(options.folder, cases[i].id), format_case(outcome.records[i]));
    ++outcome.ran;
    clock.one_ended(outcome.records[i].failed());
    if (on_case) on_case(outcome.records[i]);
  };
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  run_processes(commands, options.jobs > 0 ? options.jobs : cores, on_end, [&] { clock.show(); });
  return outcome;
}

std::vector<std::string> write_batch_results(const BatchOutcome& outcome, const std::string& folder,
                                             const std::string& manifest) {
  std::vector<std::string> paths{(fs::path(folder) / "results.csv").string(),
                                 (fs::path(folder) / "results.json").string()};
  write_together(std::vector<NamedText>{{paths[0], format_results_csv(outcome.records)},
                                        {paths[1], format_results_json(outcome.records, manifest)}});
  return paths;
}

std::string duration_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 60) return std::to_string(whole) + " s";
  const long minutes = std::lround(seconds / 60.0);
  if (minutes < 60) return std::to_string(minutes) + " min";
  return std::to_string(minutes / 60) + " h " + std::to_string(minutes % 60) + " min";
}

}  // namespace fuai
