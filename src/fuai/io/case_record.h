// What one case of a batch left behind, as a file of its own (fuai-case/1), and the tables of many.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fuai {

/// One case that has ended.
struct CaseRecord {
  std::string id;
  std::string version;             ///< of the program that ran it
  std::vector<std::string> words;  ///< the command line after the program's name, as the manifest says it
  std::string input_hash;          ///< of the fabric, curves included
  std::vector<std::pair<std::string, std::string>> settings;  ///< "fabric", then what the manifest sets
  int exit_code = 0;                                          ///< -1 when a signal ended it
  int signal = 0;
  double seconds = 0.0;  ///< wall clock
  std::string result;    ///< the JSON object that it printed, one line; empty when it printed none
  std::string messages;  ///< its standard error

  /// Whether it ended without a result or with an exit code.
  bool failed() const noexcept { return exit_code != 0 || result.empty(); }
};

/// Whether a text is one JSON object. Thread class: set-up.
bool is_json_object(std::string_view text);

/// The text of a case file. @param record its result must be empty or a JSON object. Thread class: set-up.
std::string format_case(const CaseRecord& record);

/// Reads a case file; nothing when it is broken, cut off, or of another format. Thread class: set-up.
std::optional<CaseRecord> parse_case(std::string_view text);

/// All cases as one JSON object. @param manifest its path. Thread class: set-up.
std::string format_results_json(std::span<const CaseRecord> records, const std::string& manifest);

/// All cases as CSV, a row each: `case`, `command`, `setting.*`, `exit_code`, `signal`, `wall_seconds`,
/// `message` (of failed cases), and the keys of the results with those of nested objects and lists joined by
/// dots ("drape_coefficient_percent.each.0"); a list of texts is one cell, joined by " | ".
/// @source RFC 4180, with "\n". Thread class: set-up.
std::string format_results_csv(std::span<const CaseRecord> records);

}  // namespace fuai
