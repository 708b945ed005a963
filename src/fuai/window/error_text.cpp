// Finds the sentence of an Error in the table and fills it in.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/error_text.h"

#include <cerrno>
#include <cstring>
#include <optional>
#include <vector>

namespace fuai {
namespace {

/// Messages of the system that a person meets; their English is the system's own.
constexpr struct {
  int number;
  const char* japanese;
} kSystemMessages[] = {
    {EACCES, "アクセス権がありません"},
    {EPERM, "許可されていません"},
    {ENOENT, "ファイルやフォルダがありません"},
    {ENOTDIR, "フォルダではありません"},
    {EISDIR, "フォルダです"},
    {EEXIST, "同じ名前がすでにあります"},
    {ENOSPC, "ディスクの空きがありません"},
    {EDQUOT, "ディスクの割り当てを使い切りました"},
    {EFBIG, "ファイルが大きすぎます"},
    {EROFS, "読み取り専用の場所です"},
    {EIO, "入出力の誤りです"},
    {ENAMETOOLONG, "名前が長すぎます"},
    {EMFILE, "開いているファイルが多すぎます"},
    {ENFILE, "システム全体で開いているファイルが多すぎます"},
    {ENOMEM, "メモリが足りません"},
    {EBUSY, "使用中です"},
    {ENODEV, "装置がありません"},
    {ENXIO, "装置がありません"},
    {EPIPE, "相手が終了しました"},
    {ECONNREFUSED, "接続を拒否されました"},
    {ETIMEDOUT, "時間内に応答がありません"},
    {EHOSTUNREACH, "相手に届きません"},
    {ENETUNREACH, "ネットワークに届きません"},
    {EAGAIN, "今は使えません"},
};

using Inserted = std::vector<std::string_view>;

/// What stands at the stars of a pattern; nothing where the text is another one.
std::optional<Inserted> match(std::string_view pattern, std::string_view text) {
  Inserted inserted;
  std::size_t star = pattern.find('*');
  if (star == std::string_view::npos) return pattern == text ? std::optional(inserted) : std::nullopt;
  if (!text.starts_with(pattern.substr(0, star))) return std::nullopt;
  text.remove_prefix(star);
  while (true) {
    pattern.remove_prefix(star + 1);
    star = pattern.find('*');
    const std::string_view next = pattern.substr(0, star);  // as far as the next star, or the end
    const bool last = star == std::string_view::npos;
    if (last && !text.ends_with(next)) return std::nullopt;
    const std::size_t at = last ? text.size() - next.size() : text.find(next);
    if (at == std::string_view::npos) return std::nullopt;
    inserted.push_back(text.substr(0, at));
    if (last) return inserted;
    text.remove_prefix(at + next.size());
    star = next.size();
  }
}

/// The sentence that says most of a text in its own words.
const ErrorSentence* find_sentence(std::string_view text, Inserted& inserted) {
  const ErrorSentence* best = nullptr;
  std::size_t most = 0;
  for (const ErrorSentence& sentence : error_sentences()) {
    const std::string_view pattern = sentence.english;
    std::optional<Inserted> found = match(pattern, text);
    const std::size_t own = found ? pattern.size() - found->size() : 0;
    if (own <= most) continue;
    most = own;
    best = &sentence;
    inserted = std::move(*found);
  }
  return best;
}

std::string in_japanese(std::string_view english) {
  for (const auto& message : kSystemMessages)
    if (english == std::strerror(message.number)) return message.japanese;
  Inserted inserted;
  const ErrorSentence* sentence = find_sentence(english, inserted);
  if (sentence == nullptr) return std::string(english);
  const std::string_view japanese = sentence->japanese;
  std::string text;
  for (std::size_t i = 0; i < japanese.size(); ++i) {
    const std::string_view mark = japanese.substr(i, 3);
    const bool plain = mark.size() == 3 && mark[0] == '{' && mark[2] == '}';
    const bool looked_up = mark.size() == 3 && mark[0] == '<' && mark[2] == '>';
    const std::size_t number = plain || looked_up ? static_cast<std::size_t>(mark[1] - '1') : inserted.size();
    if (number >= inserted.size()) {
      text += japanese[i];
      continue;
    }
    text += looked_up ? in_japanese(inserted[number]) : std::string(inserted[number]);
    i += 2;
  }
  return text;
}

}  // namespace

std::string error_sentence(std::string_view english, Language language) {
  return language == Language::kJapanese ? in_japanese(english) : std::string(english);
}

std::string error_text(const Error& error, Language language) {
  std::string text = to_string(error.where()) + error_sentence(error.problem(), language);
  if (!error.cure().empty())
    text += (language == Language::kJapanese ? "。" : "; ") + error_sentence(error.cure(), language);
  return text;
}

std::string error_text_without_place(const Error& error, Language language) {
  const std::string cure = error_sentence(error.cure(), language);
  return error_sentence(error.problem(), language) + (cure.empty() ? "" : " (" + cure + ")");
}

}  // namespace fuai
