// `fuai batch`: many fabrics, many settings, from one manifest.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <string>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/io/folder_lock.h"
#include "fuai/io/nearest_name.h"
#include "fuai/laboratory/batch_run.h"
#include "fuai/runtime/processes.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct BatchCommandOptions {
  std::string manifest, out;
  int jobs = 0;  ///< 0: as many as the machine has cores
  bool list = false, retry = false;
  std::vector<std::string> only;  ///< ids; empty: all, and the tables
};

/// The commands that make cases: each prints one JSON object and depends on its words alone.
constexpr const char* kCaseCommands[] = {"drape", "kes", "cantilever", "loop", "simulate"};

BatchOption::Kind kind_of(CommandShape::Kind kind) {
  switch (kind) {
    case CommandShape::Kind::kText:
      return BatchOption::Kind::kText;
    case CommandShape::Kind::kInteger:
      return BatchOption::Kind::kInteger;
    case CommandShape::Kind::kFlag:
      return BatchOption::Kind::kFlag;
    case CommandShape::Kind::kFile:
      return BatchOption::Kind::kFile;
  }
  return BatchOption::Kind::kText;
}

BatchGrammar grammar_of(CommandChecker& checker) {
  BatchGrammar grammar;
  for (const char* name : kCaseCommands) {
    const CommandShape shape = checker.shape_of(name);
    BatchCommand& command = grammar.commands.emplace_back(BatchCommand{name, {}, {}});
    for (std::string word : shape.words) {
      std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
      command.words.push_back(word);
    }
    for (const auto& [option, kind] : shape.options) command.options.push_back({option, kind_of(kind)});
  }
  grammar.problem = [&](const std::vector<std::string>& words) { return checker.problem_of(words); };
  return grammar;
}

/// A word as a shell takes it.
std::string shell_word(const std::string& word) {
  const bool plain = !word.empty() && std::ranges::all_of(word, [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
           std::string("-_./=+,:@%").find(c) != std::string::npos;
  });
  if (plain) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string shell_line(const BatchCase& one) {
  std::string line = "fuai";
  for (const std::string& word : one.line) line += " " + shell_word(word);
  return line;
}

int list_cases(const Console& console, const std::vector<BatchCase>& cases) {
  JsonValue list{JsonValue::Array{}};
  for (const BatchCase& one : cases) {
    console.line(one.id + "\t" + shell_line(one));
    JsonValue json, words{JsonValue::Array{"fuai"}};
    for (const std::string& word : one.line) words.push(word);
    list.push(json.set("case", one.id).set("command_line", words));
  }
  JsonValue json;
  console.result(json.set("cases", list));
  return 0;
}

/// The named cases, in the order of the manifest.
std::vector<BatchCase> chosen_of(const std::vector<BatchCase>& cases, const std::vector<std::string>& only) {
  std::vector<std::string> ids;
  ids.reserve(cases.size());
  for (const BatchCase& one : cases) ids.push_back(one.id);
  for (const std::string& id : only) {
    if (std::ranges::find(ids, id) != ids.end()) continue;
    const std::vector<std::string> nearest = nearest_names(id, ids);
    throw Error(ErrorKind::kUsage, "--case: the manifest has no case '" + id + "'", {},
                (nearest.empty() ? "" : "did you mean " + nearest.front() + "? ") +
                    std::string("--list prints them"));
  }
  std::vector<BatchCase> chosen;
  for (const BatchCase& one : cases)
    if (std::ranges::find(only, one.id) != only.end()) chosen.push_back(one);
  return chosen;
}

/// "exit code 3: fuai: ..." with the first line that it said as an error.
std::string reason_of(const CaseRecord& record) {
  std::string how = record.signal != 0 ? "signal " + std::to_string(record.signal)
                                       : "exit code " + std::to_string(record.exit_code);
  const std::size_t begin = record.messages.find("fuai: ");
  if (begin == std::string::npos) return how;
  return how + ": " + record.messages.substr(begin, record.messages.find('\n', begin) - begin);
}

void print_failures(const Console& console, const std::vector<BatchCase>& cases,
                    const BatchOutcome& outcome) {
  constexpr int kMostShown = 10;
  int shown = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const CaseRecord& record = outcome.records[i];
    if (!record.failed() || ++shown > kMostShown) continue;
    console.warn(to_string(cases[i].where) + "case " + record.id + " failed, " + reason_of(record));
  }
  if (shown > kMostShown)
    console.warn("and " + std::to_string(shown - kMostShown) + " more; results.csv names them");
}

JsonValue json_of(const BatchOutcome& outcome, const std::string& folder,
                  const std::vector<std::string>& files) {
  JsonValue json, failed{JsonValue::Array{}}, names{JsonValue::Array{}};
  for (const CaseRecord& record : outcome.records) {
    if (!record.failed()) continue;
    JsonValue one;
    one.set("case", record.id).set("exit_code", record.exit_code).set("signal", record.signal);
    failed.push(one.set("message", reason_of(record)));
  }
  for (const std::string& file : files) names.push(file);
  json.set("cases", static_cast<std::int64_t>(outcome.records.size()));
  json.set("kept", outcome.kept).set("ran", outcome.ran).set("failed", failed);
  return json.set("folder", folder).set("files", names);
}

int run_cases(const Console& console, const BatchCommandOptions& command,
              const std::vector<BatchCase>& cases) {
  BatchOptions options;
  options.folder = command.out;
  options.program = own_program();
  options.version = program_version();
  options.jobs = command.jobs;
  options.retry = command.retry;
  const bool all = command.only.empty();
  std::optional<FolderLock> lock;
  if (all) {
    lock.emplace(command.out);
    remove_temporary_files(command.out + "/cases");
  }
  const BatchOutcome outcome = run_batch(cases, options, console.progress(), [&](const CaseRecord& record) {
    console.detail(record.id + "  " + duration_text(record.seconds) + (record.failed() ? "  failed" : ""));
  });
  std::vector<std::string> files;
  if (all) files = write_batch_results(outcome, command.out, command.manifest);
  const auto count = [](int number) { return std::to_string(number); };
  console.line(count(static_cast<int>(cases.size())) + " cases: " + count(outcome.ran) + " run, " +
               count(outcome.kept) + " kept from before, " + count(outcome.failed()) + " failed");
  for (const std::string& file : files) console.say("wrote " + file);
  console.result(json_of(outcome, command.out, files));
  print_failures(console, cases, outcome);
  return outcome.failed() == 0 ? 0 : kExitCheckFailed;
}

int run_manifest(const Console& console, const BatchCommandOptions& command, const DeclareCommands& all) {
  if (command.out.empty() && !command.list)
    throw Error(ErrorKind::kUsage, "-o is missing: there is no folder for the results", {},
                "add -o DIR, or --list to see the cases");
  CommandChecker checker(all);
  BatchCases made = make_batch_cases(read_batch_manifest(command.manifest), grammar_of(checker), command.out);
  if (made.repeated > 0)
    console.warn(command.manifest + ": " + std::to_string(made.repeated) +
                 " cases came up twice; each is run once");
  if (!command.only.empty()) made.cases = chosen_of(made.cases, command.only);
  return command.list ? list_cases(console, made.cases) : run_cases(console, command, made.cases);
}

}  // namespace

void declare_batch(const Command& parent, const DeclareCommands& all) {
  const auto options = std::make_shared<BatchCommandOptions>();
  constexpr int kMostJobs = 1024;
  const Command command =
      parent.command("batch", "Many fabrics and settings from one manifest; a run that was killed goes on");
  command.option("MANIFEST", options->manifest, "TOML file that says which commands, fabrics and settings")
      .required();
  command.option("-o,--output", options->out, "Folder for the results");
  command.option("--jobs", options->jobs, "Cases at a time. Default: as many as the machine has cores")
      .range(1, kMostJobs);
  command.flag("--list", options->list, "Only print the cases: name, tab, command line");
  command.option("--case", options->only, "Only these cases, by name, without tables: for a cluster's queue");
  command.flag("--retry", options->retry, "Run cases again that failed");
  command.examples({"fuai batch drapes.toml -o drapes", "fuai batch drapes.toml --list",
                    "fuai batch drapes.toml --jobs 1 -o drapes --case drape-wool-tropical-0123456789abcdef"});
  command.body([options, all](const Console& console) { return run_manifest(console, *options, all); });
}

}  // namespace fuai_app
