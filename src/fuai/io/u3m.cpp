// Reads the raw tests of a U3M 1.1 physics file (Browzwear Fabric Analyzer).
// SPDX-License-Identifier: Apache-2.0
// Source: physics_schema.json of github.com/vizoogmbh/u3m; "Raw Measurement Data from FAB" 1.2, Browzwear
// 2020.
#include "fuai/io/u3m.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/io/text_file.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

using Json = nlohmann::json;

/// Deepest nesting accepted; a physics file has 6 levels.
constexpr int kDeepest = 32;

/// A value together with the path that leads to it, for messages.
class Node {
 public:
  Node(const Json& json, std::string key, const std::string& file)
      : json_(&json), key_(std::move(key)), file_(&file) {}

  const Json& json() const { return *json_; }
  const std::string& key() const { return key_; }

  [[noreturn]] void fail(const std::string& what, const std::string& cure) const {
    throw Error(ErrorKind::kBadInput, what, Where{*file_, 0, 0, key_}, cure);
  }

  bool has(const char* name) const { return json_->is_object() && json_->contains(name); }

  Node at(const char* name) const {
    if (!json_->is_object()) fail("an object is expected", "see the U3M 1.1 physics schema");
    if (!json_->contains(name))
      fail(std::string("'") + name + "' is missing", "see the U3M 1.1 physics schema; export the file again");
    return {(*json_)[name], key_.empty() ? name : key_ + "." + name, *file_};
  }

  Node at(std::size_t index) const {
    return {(*json_)[index], key_ + "[" + std::to_string(index) + "]", *file_};
  }

  /// Number of elements of a list.
  std::size_t size() const {
    if (!json_->is_array()) fail("a list is expected", "see the U3M 1.1 physics schema");
    return json_->size();
  }

  /// A finite number, also when it is written as a string.
  double number() const {
    double value = std::nan("");
    if (json_->is_number()) value = json_->get<double>();
    if (json_->is_string()) {
      const auto& text = json_->get_ref<const std::string&>();
      const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (code != std::errc() || end != text.data() + text.size()) value = std::nan("");
    }
    if (!std::isfinite(value)) fail("a finite number is expected, got " + brief(), "correct the value");
    return value;
  }

  double positive() const {
    const double value = number();
    if (!(value > 0.0)) fail("a number above zero is expected, got " + brief(), "correct the value");
    return value;
  }

  std::string text() const {
    if (!json_->is_string()) fail("a text is expected, got " + brief(), "correct the value");
    return json_->get<std::string>();
  }

  /// The value as it stands in the file, cut to 40 bytes.
  std::string brief() const {
    if (json_->is_structured()) return json_->is_array() ? "a list" : "an object";
    std::string dump = json_->dump(-1, ' ', true);
    return dump.size() > 40 ? dump.substr(0, 40) + "..." : dump;
  }

 private:
  const Json* json_;
  std::string key_;
  const std::string* file_;
};

Json parse_json(std::string_view text, const std::string& name) {
  const auto check_depth = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kDeepest) {
      throw Error(ErrorKind::kBadInput,
                  "the JSON is nested deeper than " + std::to_string(kDeepest) + " levels",
                  Where{name, 0, 0, {}}, "this is no U3M physics file");
    }
    return true;
  };
  try {
    return Json::parse(text, check_depth);
  } catch (const Json::parse_error& e) {
    throw Error(ErrorKind::kBadInput, "the JSON is broken or cut off here",
                place_of(text, std::max<std::size_t>(e.byte, 1) - 1, name), "export the file again");
  } catch (const Json::exception& e) {
    // What remains is a number outside the range of a double.
    throw Error(ErrorKind::kBadInput, std::string("the JSON cannot be read: ") + e.what(),
                Where{name, 0, 0, {}}, "correct the number");
  }
}

/// One branch: d0, f0, d1, f1, ... [cm, gf].
std::vector<FabSample> read_branch(const Node& list) {
  const std::size_t count = list.size();
  if (count == 0 || count % 2 != 0) {
    list.fail("distance and force must alternate, but the list has " + std::to_string(count) + " numbers",
              "give pairs: distance in cm, force in gf");
  }
  std::vector<FabSample> samples(count / 2);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    samples[i] = {list.at(2 * i).number() * unit::kCentimetre,
                  list.at(2 * i + 1).number() * unit::kGramForce};
  }
  return samples;
}

std::vector<std::vector<FabSample>> read_branches(const Node& tree) {
  std::vector<std::vector<FabSample>> branches;
  for (std::size_t i = 0; i < tree.size(); ++i) branches.push_back(read_branch(tree.at(i)));
  if (branches.empty()) tree.fail("there are no samples", "export the file again");
  return branches;
}

FabStripTest read_strip(const Node& part) {
  FabStripTest test;
  test.width = part.at("width").positive() * unit::kCentimetre;
  test.length = part.at("length").positive() * unit::kCentimetre;
  test.sample_rate = part.at("freq").positive();
  test.branches = read_branches(part.at("samplesTree"));
  return test;
}

/// Latest time stamp [s since 1970] of a test and its parts; 0 when there is none.
std::int64_t newest_time(const Node& measurement) {
  double newest = 0.0;
  if (measurement.has("time")) newest = measurement.at("time").number();
  for (int t = 0; t < kFabTestCount; ++t) {
    const char* name = to_string(static_cast<FabTest>(t));
    if (measurement.has(name) && measurement.at(name).has("time"))
      newest = std::max(newest, measurement.at(name).at("time").number());
  }
  constexpr double kYear3000 = 32503680000.0;
  return newest > 0.0 && newest < kYear3000 ? static_cast<std::int64_t>(newest) : 0;
}

/// "2020-01-27" (UTC) of seconds since 1970.
std::string iso_date(std::int64_t seconds) {
  const auto time = static_cast<std::time_t>(seconds);
  std::tm parts{};
  gmtime_r(&time, &parts);
  char text[32];
  return std::string(text, std::strftime(text, sizeof text, "%Y-%m-%d", &parts));
}

/// "60 % Cotton, 40 % Rayon" of [{fiber_name, percentage 0..1}].
std::string read_composition(const Node& list) {
  std::string composition;
  for (std::size_t i = 0; i < list.size(); ++i) {
    char percent[32];
    std::snprintf(percent, sizeof percent, "%.4g %% ", 100.0 * list.at(i).at("percentage").number());
    composition += (i == 0 ? "" : ", ") + (percent + list.at(i).at("fiber_name").text());
  }
  return composition;
}

/// What the vendor's section states about the fabric; every part of it is optional.
void read_vendor_section(const Node& custom, FabRecord& record) {
  if (!custom.has("browzwear")) return;
  const Node vendor = custom.at("browzwear");
  if (vendor.has("name")) record.name = vendor.at("name").text();
  if (vendor.has("category")) record.category = vendor.at("category").text();
  if (vendor.has("composition")) record.composition = read_composition(vendor.at("composition"));
  if (vendor.has("thickness")) record.thickness = vendor.at("thickness").number() * unit::kMillimetre;
  if (record.thickness < 0.0)
    vendor.at("thickness").fail("a thickness cannot be negative", "correct the value");
}

void read_raw_data(const Node& raw, FabRecord& record) {
  record.areal_mass = raw.at("M").positive() * unit::kGPerM2;
  constexpr std::pair<const char*, Direction> kStrips[] = {
      {"L", Direction::kWarp}, {"W", Direction::kWeft}, {"B", Direction::kBias}};
  std::int64_t newest = 0;
  for (const auto& [letter, direction] : kStrips) {
    const Node measurement = raw.at(letter);
    for (int t = 0; t < kFabTestCount; ++t) {
      record.strips[static_cast<std::size_t>(direction)][static_cast<std::size_t>(t)] =
          read_strip(measurement.at(to_string(static_cast<FabTest>(t))));
    }
    newest = std::max(newest, newest_time(measurement));
  }
  record.thickness_branches = read_branches(raw.at("T").at("samplesTree"));
  newest = std::max(newest, newest_time(raw.at("T")));
  if (newest > 0) record.source_date = iso_date(newest);
  if (!raw.has("warnings") || raw.at("warnings").json().is_null()) return;
  const Node warnings = raw.at("warnings");
  if (!warnings.json().is_object()) warnings.fail("an object is expected", "see the U3M 1.1 physics schema");
  for (const auto& item : warnings.json().items()) {
    record.vendor_warnings[item.key()] = warnings.at(item.key().c_str()).text();
  }
}

}  // namespace

FabRecord parse_u3m_physics(std::string_view text, const std::string& name) {
  const Json json = parse_json(text, name);
  const Node root(json, "", name);
  if (root.has("material")) {
    root.fail("this is a U3M material, not its physics file",
              "give the file that material.physics.devices.fab names");
  }
  const Node schema = root.at("schema");
  if (schema.text() != "1.1")
    schema.fail("the format is " + schema.brief() + ", not \"1.1\"", "export as U3M 1.1");
  const Node raw = root.at("raw_data");
  if (raw.json().is_null()) raw.fail("there are no measurements in this file", "export it with its raw data");
  FabRecord record;
  record.source = name;
  record.name = std::filesystem::path(name).stem().string();
  read_raw_data(raw, record);
  if (root.has("custom")) read_vendor_section(root.at("custom"), record);
  return record;
}

FabRecord read_u3m_physics(const std::string& path) { return parse_u3m_physics(read_text_file(path), path); }

}  // namespace fuai
