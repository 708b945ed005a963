// Refuses TOML text that the TOML library cannot read safely.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/toml_guard.h"

#include <algorithm>

#include "fuai/core/error.h"

namespace fuai {
namespace {

/// Walks over the text with just enough grammar to know where strings and comments are.
class Guard {
 public:
  Guard(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  void check() {
    while (at_ < text_.size()) {
      if (text_[at_] == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (text_[at_] == '"' || text_[at_] == '\'') {
        skip_string();
      } else {
        refuse_non_ascii("stands outside of quotes", "write texts, and keys with such letters, in quotes");
        ++at_;
      }
    }
  }

 private:
  /// Skips "...", '...', """...""" or '''...'''. Single-line strings also end at the end of the line: what
  /// follows is then an error that the TOML library reports.
  void skip_string() {
    // A quote in the middle of a word opens no string for the library: inside, ASCII only.
    constexpr std::string_view kBeforeStrings = " \t\n=,[{";
    const bool is_string = at_ == 0 || kBeforeStrings.find(text_[at_ - 1]) != std::string_view::npos;
    const char quote = text_[at_];
    const std::string triple(3, quote);
    const bool multi_line = text_.substr(at_, 3) == triple;
    at_ += multi_line ? 3 : 1;
    while (at_ < text_.size()) {
      if (multi_line ? text_.substr(at_, 3) == triple : text_[at_] == quote) {
        at_ += multi_line ? 3 : 1;
        // Up to two quotes may stand right before the closing three.
        while (multi_line && at_ < text_.size() && text_[at_] == quote) ++at_;
        return;
      }
      if (!multi_line && text_[at_] == '\n') return;
      if (!is_string) refuse_non_ascii("stands inside a word", "put the whole word in quotes");
      if (quote == '"' && text_[at_] == '\\') {
        skip_escape(multi_line);
      } else {
        ++at_;
      }
    }
  }

  /// Skips a backslash and what it escapes; one that continues the line takes the blanks behind it along.
  void skip_escape(bool multi_line) {
    ++at_;
    if (at_ < text_.size()) refuse_non_ascii("follows a backslash", "write two backslashes if one is meant");
    const auto is_blank = [](char c) { return c == ' ' || (c >= '\t' && c <= '\r'); };
    if (!multi_line || at_ >= text_.size() || !is_blank(text_[at_])) {
      if (at_ < text_.size() && text_[at_] != '\n') ++at_;
      return;
    }
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    if (at_ < text_.size())
      refuse_non_ascii("follows a continued line", "remove the backslash at the end of the line");
  }

  /// Throws when the current character is beyond ASCII.
  void refuse_non_ascii(const char* what, const char* cure) const {
    if (static_cast<unsigned char>(text_[at_]) < 0x80) return;
    const std::string_view before = text_.substr(0, at_);
    const auto line = std::count(before.begin(), before.end(), '\n') + 1;
    std::size_t length = 1;
    while (at_ + length < text_.size() && (static_cast<unsigned char>(text_[at_ + length]) & 0xC0) == 0x80)
      ++length;
    throw Error(
        ErrorKind::kBadInput, "the character '" + std::string(text_.substr(at_, length)) + "' " + what,
        Where{name_, static_cast<int>(line), static_cast<int>(at_ - (before.rfind('\n') + 1)) + 1, {}}, cure);
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

}  // namespace

void check_toml_text(std::string_view text, const std::string& name) {
  const auto nesting =
      std::count_if(text.begin(), text.end(), [](char c) { return c == '.' || c == '[' || c == '{'; });
  if (nesting > kMostNesting) {
    throw Error(ErrorKind::kBadInput,
                "there are more than " + std::to_string(kMostNesting) + " dots and brackets",
                Where{name, 0, 0, {}}, "this is no fabric file; put curves into CSV files of their own");
  }
  Guard(text, name).check();
}

}  // namespace fuai
