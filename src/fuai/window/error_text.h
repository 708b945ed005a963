// What an Error says, in the language of the window.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/window/ui_text.h"

namespace fuai {

/// A sentence of an Error, without its full stop, in both languages, UTF-8.
struct ErrorSentence {
  const char* english;  ///< as the sources say it; * stands for what is inserted
  /// {1} is the first of what is inserted, as it is; <1> the same, itself looked up where it is a sentence, a
  /// word of the table or a message of the system.
  const char* japanese;
};

/// All of them; kept complete by tests/window/test_error_texts.py. Thread class: any.
std::span<const ErrorSentence> error_sentences();

/// A problem or a cure in a language; English where the table lacks it. Thread class: any.
std::string error_sentence(std::string_view english, Language language);

/// "file:line:column: key: problem; cure" in a language. Thread class: any.
std::string error_text(const Error& error, Language language);

/// "problem (cure)", without the place. Thread class: any.
std::string error_text_without_place(const Error& error, Language language);

}  // namespace fuai
