// Makes the command lines of a batch.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/batch_cases.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"
#include "fuai/io/nearest_name.h"
#include "fuai/laboratory/batch_fabrics.h"

namespace fuai {
namespace {

constexpr const char* kSeed = "seed";
constexpr const char* kThreads = "threads";
constexpr const char* kFabric = "fabric";

/// A setting with the one value that a case gives it.
struct Choice {
  const BatchSetting* setting = nullptr;
  const BatchValue* value = nullptr;
};

std::string shown(const BatchValue& value) {
  if (value.kind == BatchValue::Kind::kBoolean) return value.boolean ? "true" : "false";
  std::string text;
  for (const std::string& word : value.words) text += (text.empty() ? "" : " ") + word;
  return text;
}

std::string id_of(const BatchCommand& command, const std::string& fabric,
                  const std::vector<std::string>& words) {
  StateHash hash;
  for (const std::string& word : words)
    hash.add(word.c_str(), word.size() + 1);  // with its end: no two alike
  std::string id = command.name + "-";
  for (const char c : fabric.substr(0, 60)) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '-' || c == '_' || static_cast<unsigned char>(c) >= 0x80;
    id += plain ? c : '-';
  }
  return id + (fabric.empty() ? "" : "-") + hash.hex();
}

/// Makes the cases of one block.
class Block {
 public:
  Block(const BatchBlock& block, const BatchGrammar& grammar, const std::string& folder)
      : block_(block), grammar_(grammar), folder_(folder), command_(command_of()) {
    for (const std::string& word : command_.words) known_.push_back(word);
    for (const BatchOption& option : command_.options) known_.push_back(option.name);
    known_.insert(known_.end(), {kSeed, kThreads});
    std::erase(known_, kFabric);
    for (const BatchSetting& setting : block_.settings) check(setting);
    for (const auto& variant : block_.variants)
      for (const BatchSetting& setting : variant) check(setting);
  }

  bool takes_fabric() const { return has_word(kFabric) || option_of(kFabric) != nullptr; }

  /// Calls `add` with every case, for each fabric; an empty list stands for no fabric.
  void each(const std::vector<BatchFabric>& fabrics, const std::function<void(BatchCase)>& add) const {
    if (fabrics.empty() && has_word(kFabric)) {
      throw Error(ErrorKind::kBadInput, "there is no fabric", block_.where,
                  "write fabrics = [\"wool-tropical\"] here or at the top");
    }
    const std::vector<BatchFabric> none(1);
    bool first = true;
    for (const BatchFabric& fabric : fabrics.empty() ? none : fabrics) {
      for (const std::vector<Choice>& choices : product()) {
        BatchCase made = make(fabric, choices);
        if (first) check(made, choices);  // the fabric makes no difference to the parser
        add(std::move(made));
      }
      first = false;
    }
  }

 private:
  const BatchCommand& command_of() const {
    const auto found = std::ranges::find(grammar_.commands, block_.command, &BatchCommand::name);
    if (found != grammar_.commands.end()) return *found;
    std::vector<std::string> names;
    for (const BatchCommand& command : grammar_.commands) names.push_back(command.name);
    const std::vector<std::string> nearest = nearest_names(block_.command, names);
    throw Error(ErrorKind::kBadInput, "no command '" + block_.command + "' makes cases", block_.where,
                (nearest.empty() ? "" : "did you mean " + nearest.front() + "? ") +
                    std::string("There are ") + either(names));
  }

  bool has_word(const std::string& name) const {
    return std::ranges::find(command_.words, name) != command_.words.end();
  }

  const BatchOption* option_of(const std::string& name) const {
    const auto found = std::ranges::find(command_.options, name, &BatchOption::name);
    return found == command_.options.end() ? nullptr : &*found;
  }

  void check(const BatchSetting& setting) const {
    if (setting.name == kFabric)
      throw Error(ErrorKind::kBadInput, "unknown key", setting.where, "write fabrics = [ ... ]");
    if (std::ranges::find(known_, setting.name) == known_.end()) {
      const std::vector<std::string> nearest = nearest_names(setting.name, known_);
      throw Error(ErrorKind::kBadInput, "`fuai " + command_.name + "` has no setting '" + setting.name + "'",
                  setting.where,
                  (nearest.empty() ? "" : "did you mean " + nearest.front() + "? ") + std::string("`fuai ") +
                      command_.name + " --help` lists them");
    }
    for (const BatchValue& value : setting.values) check(setting.name, value);
  }

  /// Whether the value is of the kind that the setting takes.
  void check(const std::string& name, const BatchValue& value) const {
    const BatchOption* option = option_of(name);
    const auto fail = [&](const char* what, const std::string& cure) {
      throw Error(ErrorKind::kBadInput, what, value.where, cure);
    };
    const bool flag = option && option->kind == BatchOption::Kind::kFlag;
    const bool boolean = value.kind == BatchValue::Kind::kBoolean;
    if (flag && !boolean) fail("true or false is expected", "write " + name + " = true, or [false, true]");
    if (!flag && boolean)
      fail("a value is expected, not true or false", "write the value, or remove the key");
    if (!option) return;  // the seed and the threads are numbers, the words of a command are texts
    const std::string word = value.words.empty() ? "" : value.words.front();
    if (option->kind == BatchOption::Kind::kText && value.kind == BatchValue::Kind::kNumber)
      fail("a number alone is not expected", "write it in quotes with its unit: " + name + " = \"" + word +
                                                 "cm\", or \"" + word + "\" where it has none");
    if (option->kind != BatchOption::Kind::kFile) return;
    const std::filesystem::path file(word);
    if (word.empty() || file.is_absolute() || std::ranges::find(file, "..") != file.end())
      fail("this is no name of a file of a case", "write a name such as \"" + name +
                                                      "\"; it goes to files/ in the folder of the results, "
                                                      "below the name of the case");
  }

  /// Every variant with every combination of the values, the last setting running fastest.
  std::vector<std::vector<Choice>> product() const {
    std::vector<std::vector<Choice>> all;
    if (block_.variants.empty()) all.emplace_back();
    for (const auto& variant : block_.variants) {
      std::vector<Choice>& choices = all.emplace_back();
      for (const BatchSetting& setting : variant) choices.push_back({&setting, &setting.values.front()});
    }
    for (const BatchSetting& setting : block_.settings) {
      if (all.size() * setting.values.size() > kMostBatchCases)
        throw Error(ErrorKind::kBadInput, "these are more than " + std::to_string(kMostBatchCases) + " cases",
                    setting.where, "split the manifest");
      std::vector<std::vector<Choice>> longer;
      for (const std::vector<Choice>& choices : all) {
        for (const BatchValue& value : setting.values) {
          longer.push_back(choices);
          longer.back().push_back({&setting, &value});
        }
      }
      all = std::move(longer);
    }
    return all;
  }

  static const BatchValue* value_of(const std::vector<Choice>& choices, const std::string& name) {
    for (const Choice& choice : choices)
      if (choice.setting->name == name) return choice.value;
    return nullptr;
  }

  BatchCase make(const BatchFabric& fabric, const std::vector<Choice>& choices) const {
    BatchCase made;
    made.where = block_.where;
    made.input_hash = fabric.hash;
    if (!fabric.name.empty()) made.settings.emplace_back(kFabric, fabric.name);
    for (const Choice& choice : choices)
      made.settings.emplace_back(choice.setting->name, shown(*choice.value));
    const auto add = [&](const std::string& word, const std::string& here) {
      made.words.push_back(word);
      made.line.push_back(here);
    };
    const auto add_global = [&](const char* name, const char* otherwise) {
      const BatchValue* value = value_of(choices, name);
      add(std::string("--") + name, std::string("--") + name);
      const std::string word = value && !value->words.empty() ? value->words.front() : otherwise;
      add(word, word);
    };
    add("--json", "--json");
    add_global(kSeed, "0");
    add_global(kThreads, "1");
    add(command_.name, command_.name);
    for (const std::string& word : command_.words) add_word(word, fabric, choices, add);
    // Files need the name of the case, which follows from the words.
    for (const BatchOption& option : command_.options) add_option(option, fabric, choices, made);
    made.id = id_of(command_, fabric.id, made.words);
    place_files(made);
    return made;
  }

  template <class Add>
  void add_word(const std::string& word, const BatchFabric& fabric, const std::vector<Choice>& choices,
                const Add& add) const {
    if (word == kFabric) {
      add(fabric.name, fabric.path);
    } else if (const BatchValue* value = value_of(choices, word)) {
      for (const std::string& text : value->words) add(text, text);
    } else {
      throw Error(ErrorKind::kBadInput, "`fuai " + command_.name + "` needs '" + word + "'", block_.where,
                  "write " + word + " = \"...\"; `fuai " + command_.name + " --help` says what there is");
    }
  }

  static void add_option(const BatchOption& option, const BatchFabric& fabric,
                         const std::vector<Choice>& choices, BatchCase& made) {
    const auto add = [&](const std::string& word, const std::string& here) {
      made.words.push_back(word);
      made.line.push_back(here);
    };
    const std::string dashes = "--" + option.name;
    if (option.name == kFabric && !fabric.name.empty()) {
      add(dashes, dashes);
      add(fabric.name, fabric.path);
    }
    const BatchValue* value = value_of(choices, option.name);
    if (!value || (option.kind == BatchOption::Kind::kFlag && !value->boolean)) return;
    if (option.kind == BatchOption::Kind::kFlag) return add(dashes, dashes);
    if (option.kind == BatchOption::Kind::kFile) made.file_folder = "files";
    // A word that begins with a dash would be taken for an option.
    if (value->words.size() == 1 && value->words.front().starts_with('-')) {
      const std::string joined = dashes + "=" + value->words.front();
      return add(joined, joined);
    }
    add(dashes, dashes);
    for (const std::string& word : value->words) add(word, word);
  }

  /// Gives files the folder of their case.
  void place_files(BatchCase& made) const {
    if (made.file_folder.empty()) return;
    const std::filesystem::path place = std::filesystem::path(folder_) / "files" / made.id;
    made.file_folder = place.string();
    for (const BatchOption& option : command_.options) {
      if (option.kind != BatchOption::Kind::kFile) continue;
      const auto at = std::ranges::find(made.line, "--" + option.name);
      if (at != made.line.end() && at + 1 != made.line.end()) *(at + 1) = (place / *(at + 1)).string();
    }
  }

  /// Asks the parser; blames the value that it names.
  void check(const BatchCase& made, const std::vector<Choice>& choices) const {
    const std::string problem = grammar_.problem ? grammar_.problem(made.words) : "";
    if (problem.empty()) return;
    Where where = block_.where;
    for (const Choice& choice : choices) {
      const std::string& name = choice.setting->name;
      const bool word = has_word(name) && problem.find(choice.value->words.front()) != std::string::npos;
      if (word || problem.find("--" + name) != std::string::npos) where = choice.value->where;
    }
    throw Error(ErrorKind::kBadInput, problem, where, "see `fuai " + command_.name + " --help`");
  }

  const BatchBlock& block_;
  const BatchGrammar& grammar_;
  const std::string& folder_;
  const BatchCommand& command_;
  std::vector<std::string> known_;
};

}  // namespace

BatchCases make_batch_cases(const BatchManifest& manifest, const BatchGrammar& grammar,
                            const std::string& folder) {
  BatchCases made;
  std::set<std::vector<std::string>> seen;
  for (const BatchBlock& description : manifest.blocks) {
    const Block block(description, grammar, folder);
    std::vector<BatchFabric> fabrics;
    if (block.takes_fabric()) fabrics = find_batch_fabrics(description.fabrics, manifest.path);
    block.each(fabrics, [&](BatchCase one) {
      if (!seen.insert(one.words).second) {
        ++made.repeated;
        return;
      }
      if (made.cases.size() == kMostBatchCases)
        throw Error(ErrorKind::kBadInput, "these are more than " + std::to_string(kMostBatchCases) + " cases",
                    description.where, "split the manifest");
      made.cases.push_back(std::move(one));
    });
  }
  return made;
}

}  // namespace fuai
