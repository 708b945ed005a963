// A small tree of values that a command fills and --json prints.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace fuai_app {

/// Null, boolean, number, text, array or object with its keys in the order of insertion.
class JsonValue {
 public:
  using Array = std::vector<JsonValue>;
  using Object = std::vector<std::pair<std::string, JsonValue>>;

  JsonValue() = default;
  JsonValue(bool value) : data_(value) {}                      // NOLINT(google-explicit-constructor)
  JsonValue(int value) : data_(std::int64_t{value}) {}         // NOLINT(google-explicit-constructor)
  JsonValue(std::int64_t value) : data_(value) {}              // NOLINT(google-explicit-constructor)
  JsonValue(double value) : data_(value) {}                    // NOLINT(google-explicit-constructor)
  JsonValue(const char* value) : data_(std::string(value)) {}  // NOLINT(google-explicit-constructor)
  JsonValue(std::string value) : data_(std::move(value)) {}    // NOLINT(google-explicit-constructor)
  JsonValue(Array value) : data_(std::move(value)) {}          // NOLINT(google-explicit-constructor)
  JsonValue(Object value) : data_(std::move(value)) {}         // NOLINT(google-explicit-constructor)

  /// Adds a key to an object (a null value becomes an object first).
  JsonValue& set(std::string key, JsonValue value);
  /// Adds an element to an array (a null value becomes an array first).
  JsonValue& push(JsonValue value);

  /// One line of JSON text; NaN and infinities become null, as JSON has no word for them.
  std::string dump() const;

 private:
  friend struct JsonDumper;
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Object> data_;
};

}  // namespace fuai_app
