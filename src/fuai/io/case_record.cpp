// Case files of a batch, and the tables of many.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/case_record.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

namespace fuai {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "fuai-case/1";
constexpr const char* kResultsFormat = "fuai-batch-results/1";
/// Deepest nesting that is taken; the commands have 4 levels.
constexpr int kDeepest = 32;

/// An object, or nothing for broken text and for text that nests too deep.
std::optional<Json> parse_object(std::string_view text) {
  bool too_deep = false;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    too_deep = too_deep || depth > kDeepest;
    return !too_deep;
  };
  Json json = Json::parse(text, watch, false);
  if (too_deep || !json.is_object()) return std::nullopt;
  return json;
}

/// One line; text that is not UTF-8 is mended.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json json_of(const CaseRecord& record) {
  Json json, settings = Json::object();
  for (const auto& [name, value] : record.settings) settings[name] = value;
  json["format"] = kFormat;
  json["case"] = record.id;
  json["version"] = record.version;
  json["words"] = record.words;
  json["input_hash"] = record.input_hash;
  json["settings"] = settings;
  json["exit_code"] = record.exit_code;
  json["signal"] = record.signal;
  json["wall_seconds"] = record.seconds;
  json["result"] = record.result.empty() ? Json(nullptr) : Json::parse(record.result);
  json["messages"] = record.messages;
  return json;
}

using Cells = std::vector<std::pair<std::string, std::string>>;

bool is_text_list(const Json& json) {
  return json.is_array() && !json.empty() &&
         std::ranges::all_of(json, [](const Json& item) { return item.is_string(); });
}

/// Adds a cell for every value below `json`.
void flatten(const Json& json, const std::string& key, Cells& cells) {
  const auto below = [&](const std::string& part) { return key.empty() ? part : key + "." + part; };
  if (json.is_object()) {
    for (const auto& [name, value] : json.items()) flatten(value, below(name), cells);
  } else if (is_text_list(json)) {
    std::string text;
    for (const Json& item : json) text += (text.empty() ? "" : " | ") + item.get<std::string>();
    cells.emplace_back(key, text);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) flatten(json[i], below(std::to_string(i)), cells);
  } else if (json.is_null()) {
    cells.emplace_back(key, "");
  } else {
    cells.emplace_back(key, json.is_string() ? json.get<std::string>() : dump(json));
  }
}

Cells cells_of(const CaseRecord& record) {
  std::string command = "fuai";
  for (const std::string& word : record.words) command += " " + word;
  Cells cells{{"case", record.id}, {"command", command}};
  for (const auto& [name, value] : record.settings) cells.emplace_back("setting." + name, value);
  cells.emplace_back("exit_code", std::to_string(record.exit_code));
  cells.emplace_back("signal", std::to_string(record.signal));
  cells.emplace_back("wall_seconds", dump(Json(record.seconds)));
  cells.emplace_back("message", record.failed() ? record.messages : "");
  if (!record.result.empty()) flatten(Json::parse(record.result), "", cells);
  return cells;
}

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// Every column of every row. A new one goes behind the one that it followed where it was first seen, so that
/// keys that belong together stay together.
std::vector<std::string> columns_of(std::span<const Cells> rows) {
  std::vector<std::string> columns;
  for (const Cells& row : rows) {
    auto at = columns.begin();
    for (const auto& [key, value] : row) {
      const auto found = std::ranges::find(columns, key);
      at = found != columns.end() ? found + 1 : columns.insert(at, key) + 1;
    }
  }
  return columns;
}

}  // namespace

bool is_json_object(std::string_view text) { return parse_object(text).has_value(); }

std::string format_case(const CaseRecord& record) { return dump(json_of(record)) + "\n"; }

std::optional<CaseRecord> parse_case(std::string_view text) {
  const std::optional<Json> json = parse_object(text);
  if (!json || json->value("format", Json()) != Json(kFormat)) return std::nullopt;
  CaseRecord record;
  try {
    json->at("case").get_to(record.id);
    json->at("version").get_to(record.version);
    json->at("words").get_to(record.words);
    json->at("input_hash").get_to(record.input_hash);
    for (const auto& [name, value] : json->at("settings").items())
      record.settings.emplace_back(name, value.get<std::string>());
    json->at("exit_code").get_to(record.exit_code);
    json->at("signal").get_to(record.signal);
    json->at("wall_seconds").get_to(record.seconds);
    json->at("messages").get_to(record.messages);
    const Json& result = json->at("result");
    if (!result.is_null() && !result.is_object()) return std::nullopt;
    if (result.is_object()) record.result = dump(result);
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return record;
}

std::string format_results_json(std::span<const CaseRecord> records, const std::string& manifest) {
  Json json, cases = Json::array();
  for (const CaseRecord& record : records) cases.push_back(json_of(record));
  json["format"] = kResultsFormat;
  json["manifest"] = manifest;
  json["failed"] = std::ranges::count_if(records, [](const CaseRecord& r) { return r.failed(); });
  json["cases"] = std::move(cases);
  return dump(json) + "\n";
}

std::string format_results_csv(std::span<const CaseRecord> records) {
  std::vector<Cells> rows;
  for (const CaseRecord& record : records) rows.push_back(cells_of(record));
  const std::vector<std::string> columns = columns_of(rows);
  std::string text;
  for (const std::string& column : columns) text += (text.empty() ? "" : ",") + csv_cell(column);
  text += "\n";
  for (const Cells& row : rows) {
    const std::map<std::string, std::string> values(row.begin(), row.end());
    std::string line;
    for (const std::string& column : columns) {
      const auto found = values.find(column);
      line += (&column == columns.data() ? "" : ",") + (found == values.end() ? "" : csv_cell(found->second));
    }
    text += line + "\n";
  }
  return text;
}

}  // namespace fuai
