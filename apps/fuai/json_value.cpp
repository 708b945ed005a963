// Prints a JsonValue; the only file of the program that includes the JSON library.
// SPDX-License-Identifier: Apache-2.0
#include "json_value.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace fuai_app {

struct JsonDumper {
  static nlohmann::ordered_json convert(const JsonValue& value) {
    return std::visit(
        [](const auto& v) -> nlohmann::ordered_json {
          using T = std::decay_t<decltype(v)>;
          if constexpr (std::is_same_v<T, std::monostate>) {
            return nullptr;
          } else if constexpr (std::is_same_v<T, double>) {
            return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
          } else if constexpr (std::is_same_v<T, JsonValue::Array>) {
            auto array = nlohmann::ordered_json::array();
            for (const JsonValue& element : v) array.push_back(convert(element));
            return array;
          } else if constexpr (std::is_same_v<T, JsonValue::Object>) {
            auto object = nlohmann::ordered_json::object();
            for (const auto& [key, element] : v) object[key] = convert(element);
            return object;
          } else {
            return v;
          }
        },
        value.data_);
  }
};

JsonValue& JsonValue::set(std::string key, JsonValue value) {
  if (std::holds_alternative<std::monostate>(data_)) data_ = Object{};
  std::get<Object>(data_).emplace_back(std::move(key), std::move(value));
  return *this;
}

JsonValue& JsonValue::push(JsonValue value) {
  if (std::holds_alternative<std::monostate>(data_)) data_ = Array{};
  std::get<Array>(data_).push_back(std::move(value));
  return *this;
}

std::string JsonValue::dump() const {
  return JsonDumper::convert(*this).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace fuai_app
