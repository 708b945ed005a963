// Walks over a JSON text and calls back for each value with its path: no tree, no allocation, nothing thrown.
// SPDX-License-Identifier: Apache-2.0
// Source: RFC 8259. Strings keep their escapes, and their bytes are not checked to be UTF-8.
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace fuai {

/// Deeper texts are refused.
inline constexpr std::size_t kJsonMostDepth = 16;

enum class JsonKind { kObject, kArray, kString, kNumber, kBool, kNull };

/// One value. An object or array is told before what is in it.
struct JsonItem {
  /// A step of the way: a key of an object, or, with an empty key, a place in an array.
  struct Step {
    std::string_view key;
    std::size_t index = 0;
  };
  std::array<Step, kJsonMostDepth> path;
  std::size_t depth = 0;  ///< steps of the path in use
  JsonKind kind = JsonKind::kNull;
  std::string_view text;  ///< of a string
  double number = 0.0;
  bool truth = false;

  /// Key of a step, counted from the end; empty beyond the beginning.
  std::string_view key(std::size_t from_end = 0) const noexcept {
    return from_end < depth ? path[depth - 1 - from_end].key : std::string_view{};
  }
};

/// See walk_json().
template <class Visit>
class JsonWalk {
 public:
  JsonWalk(std::string_view text, Visit& visit) noexcept : text_(text), visit_(visit) {}
  bool run() noexcept {
    if (!value()) return false;
    blanks();
    return at_ == text_.size();
  }

 private:
  bool is(char c) const noexcept { return at_ < text_.size() && text_[at_] == c; }
  bool digit() const noexcept { return at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '9'; }
  bool take(char c) noexcept {
    if (!is(c)) return false;
    ++at_;
    return true;
  }
  void blanks() noexcept {
    while (is(' ') || is('\t') || is('\n') || is('\r')) ++at_;
  }
  bool word(std::string_view wanted) noexcept {
    if (text_.substr(at_, wanted.size()) != wanted) return false;
    at_ += wanted.size();
    return true;
  }
  bool tell(JsonKind kind) noexcept {
    item_.kind = kind;
    visit_(static_cast<const JsonItem&>(item_));
    return true;
  }
  static bool hexadecimal(char c) noexcept {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
  }
  bool string(std::string_view& out) noexcept {
    if (!take('"')) return false;
    const std::size_t begin = at_;
    for (; at_ < text_.size() && text_[at_] != '"'; ++at_) {
      if (static_cast<unsigned char>(text_[at_]) < 0x20) return false;
      if (text_[at_] != '\\') continue;
      ++at_;
      if (is('u')) {
        for (int i = 0; i < 4; ++i)
          if (++at_ >= text_.size() || !hexadecimal(text_[at_])) return false;
      } else if (at_ >= text_.size() || std::string_view("\"\\/bfnrt").find(text_[at_]) == text_.npos) {
        return false;
      }
    }
    out = text_.substr(begin, at_ - begin);
    return take('"');
  }
  bool number() noexcept {
    const std::size_t begin = at_;
    take('-');
    if (!take('0')) {
      if (!digit()) return false;
      while (digit()) ++at_;
    }
    if (take('.')) {
      if (!digit()) return false;
      while (digit()) ++at_;
    }
    if (is('e') || is('E')) {
      ++at_;
      if (!take('+')) take('-');
      if (!digit()) return false;
      while (digit()) ++at_;
    }
    item_.number = 0.0;
    const std::from_chars_result read =
        std::from_chars(text_.data() + begin, text_.data() + at_, item_.number);
    // Beyond the range of a double, on either side, it is no number for us.
    return read.ec == std::errc{} && tell(JsonKind::kNumber);
  }
  bool object() noexcept {
    ++at_;
    tell(JsonKind::kObject);
    if (item_.depth == kJsonMostDepth) return false;
    blanks();
    if (take('}')) return true;
    ++item_.depth;
    do {
      blanks();
      std::string_view key;
      if (!string(key)) return false;
      blanks();
      if (!take(':')) return false;
      item_.path[item_.depth - 1] = {key, 0};
      if (!value()) return false;
      blanks();
    } while (take(','));
    --item_.depth;
    return take('}');
  }
  bool array() noexcept {
    ++at_;
    tell(JsonKind::kArray);
    if (item_.depth == kJsonMostDepth) return false;
    blanks();
    if (take(']')) return true;
    ++item_.depth;
    std::size_t index = 0;
    do {
      item_.path[item_.depth - 1] = {{}, index++};
      if (!value()) return false;
      blanks();
    } while (take(','));
    --item_.depth;
    return take(']');
  }
  bool value() noexcept {
    blanks();
    if (at_ >= text_.size()) return false;
    switch (text_[at_]) {
      case '{':
        return object();
      case '[':
        return array();
      case '"':
        return string(item_.text) && tell(JsonKind::kString);
      case 't':
        item_.truth = true;
        return word("true") && tell(JsonKind::kBool);
      case 'f':
        item_.truth = false;
        return word("false") && tell(JsonKind::kBool);
      case 'n':
        return word("null") && tell(JsonKind::kNull);
      default:
        return number();
    }
  }

  std::string_view text_;
  Visit& visit_;
  std::size_t at_ = 0;
  JsonItem item_;
};

/// Calls visit(const JsonItem&) for each value in the order of the text. @return whether all of it is JSON,
/// at most kJsonMostDepth deep, with numbers that a double holds; before a fault, values may have been told.
/// Thread class: real-time (as far as visit is).
template <class Visit>
bool walk_json(std::string_view text, Visit&& visit) noexcept {
  return JsonWalk<std::remove_reference_t<Visit>>(text, visit).run();
}

}  // namespace fuai
