// The walk over JSON against nlohmann-json: the same texts, the same values.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <string>

#include "fuai/device/json_walk_rt.h"

using namespace fuai;

namespace {

/// Path -> value, of all scalars, both as text.
using Leaves = std::map<std::string, std::string>;

Leaves walked(const std::string& text, bool& good) {
  Leaves leaves;
  good = walk_json(text, [&](const JsonItem& item) {
    if (item.kind == JsonKind::kObject || item.kind == JsonKind::kArray) return;
    std::string path;
    for (std::size_t i = 0; i < item.depth; ++i)
      path += "/" +
              (item.path[i].key.empty() ? std::to_string(item.path[i].index) : std::string(item.path[i].key));
    std::string value = "null";
    if (item.kind == JsonKind::kString) value = "\"" + std::string(item.text) + "\"";
    if (item.kind == JsonKind::kNumber) value = std::to_string(item.number);
    if (item.kind == JsonKind::kBool) value = item.truth ? "true" : "false";
    leaves[path] = value;
  });
  return leaves;
}

void collect(const nlohmann::json& json, const std::string& path, Leaves& leaves) {
  if (json.is_object()) {
    for (const auto& [key, value] : json.items()) collect(value, path + "/" + key, leaves);
  } else if (json.is_array()) {
    for (std::size_t i = 0; i < json.size(); ++i) collect(json[i], path + "/" + std::to_string(i), leaves);
  } else {
    leaves[path] = json.is_number() ? std::to_string(json.get<double>()) : json.dump();
  }
}

nlohmann::json random_json(std::mt19937& random, int depth) {
  const auto below = [&](std::size_t n) { return std::size_t{random()} % n; };
  nlohmann::json json;
  switch (below(depth > 0 ? 6 : 4)) {
    case 0:
      return (static_cast<double>(below(20001)) - 10000.0) * 1e-3;
    case 1:
      return below(2) == 1;
    case 2:
      return nullptr;
    case 3:
      return "s\"\\\n" + std::to_string(below(100));
    case 4:
      json = nlohmann::json::array();
      for (std::size_t i = below(4); i > 0; --i) json.push_back(random_json(random, depth - 1));
      return json;
    default:
      json = nlohmann::json::object();
      for (std::size_t i = below(4); i > 0; --i)
        json["k" + std::to_string(i)] = random_json(random, depth - 1);
      return json;
  }
}

}  // namespace

TEST_SUITE("crosscheck") {
  TEST_CASE("JSON: random texts have the same leaves, broken ones are refused like there") {
    std::mt19937 random(5);
    int broken = 0;
    for (int i = 0; i < 3000; ++i) {
      const nlohmann::json json = random_json(random, 5);
      std::string text = json.dump(i % 3 == 0 ? 2 : -1);
      Leaves expected;
      collect(json, "", expected);
      bool good = false;
      const Leaves found = walked(text, good);
      REQUIRE(good);
      REQUIRE(found == expected);
      text[random() % text.size()] = " \"{}[]:,0-e.tx\\"[random() % 14];
      const bool also = nlohmann::json::accept(text);
      walked(text, good);
      CAPTURE(text);
      CHECK(good == also);
      broken += also ? 0 : 1;
    }
    CHECK(broken > 500);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("JSON: what is refused") {
    const auto good = [](const std::string& text) { return walk_json(text, [](const JsonItem&) {}); };
    for (const char* text :
         {"",       " ",    "nul",        "01",        "1.",    ".5",  "+1",      "1e",
          "-",      "[1,]", "{\"a\":1,}", "{a:1}",     "[1",    "\"a", "\"\\x\"", "\"\\u12g4\"",
          "\"\n\"", "1 2",  "[1 2]",      "{\"a\" 1}", "1e999", "tru"})
      CHECK_MESSAGE(!good(text), text);
    CHECK(good("\"\\u12a4\\n\""));
    CHECK(good(std::string(kJsonMostDepth, '[') + std::string(kJsonMostDepth, ']')));
    CHECK(!good(std::string(kJsonMostDepth + 2, '[') + std::string(kJsonMostDepth + 2, ']')));
    CHECK(!good(std::string(1000000, '[')));
  }
}
