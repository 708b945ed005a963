// What an Error says in a Japanese window.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cerrno>
#include <cstring>
#include <functional>
#include <string>

#include "fuai/fabric/laws.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/kes_sheet.h"
#include "fuai/io/text_file.h"
#include "fuai/io/u3m.h"
#include "fuai/scenes/catalogue.h"
#include "fuai/window/error_text.h"

namespace {

using namespace fuai;

std::string japanese(const std::function<void()>& work) {
  try {
    work();
  } catch (const Error& e) {
    CHECK(error_text(e, Language::kEnglish) == e.what());
    return error_text(e, Language::kJapanese);
  }
  return "nothing was thrown";
}

std::string japanese(std::string_view english) { return error_sentence(english, Language::kJapanese); }

constexpr const char* kHead =
    "format = \"fuai-fabric/1\"\nname = \"Wool\"\n[weight]\nW_mg_per_cm2 = 16.3\n[bending.warp]\n";

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("What the readers throw is told in Japanese, with its place") {
    CHECK(japanese([] { parse_fabric(std::string(kHead) + "B_gf_cm2_per_cm = -0.067\n", "w.toml", "."); }) ==
          "w.toml:6:19: bending.warp.B_gf_cm2_per_cm: -0.067 gf·cm²/cm は負です。"
          "負にならない量です。符号を確認してください");
    CHECK(japanese([] { parse_fabric(std::string(kHead) + "B_gf_cm_per_cm2 = 1\n", "w.toml", "."); }) ==
          "w.toml:6:1: bending.warp.B_gf_cm_per_cm2: このキーはありません。"
          "B_gf_cm2_per_cm と書いてください");
    CHECK(japanese([] { parse_fabric("name = \"x\"\n", "w.toml", "."); }) ==
          "w.toml: format: 「format」がないか、空です。"
          "ファイルの先頭に format = \"fuai-fabric/1\" と書いてください");
    CHECK(japanese([] { parse_kes_sheet("name,B1,B2\nWool,0.1,x\n", "s.csv"); }) ==
          "s.csv:2:10: B2: 'x' は数値ではありません。0.067 のように数値を書いてください");
    CHECK(japanese([] { parse_kes_sheet("name,stiffness [gf cm2/cm],G\nWool,0.1,1\n", "s.csv"); }) ==
          "s.csv:1:6: 見出し「stiffness [gf cm2/cm]」は複数の特性値に取れます。記号で書いてください：B or G");
    CHECK(japanese([] {
            parse_curve_csv("# fuai-curve/1 test=bending direction=warp\na,b\n1,2\n", "c.csv", {});
          }) ==
          "c.csv:2:1: 曲げ曲線の列の見出しがありません。"
          "見出し curvature_per_cm,moment_gf_cm_per_cm,branch を書いてください");
    CHECK(japanese([] { parse_u3m_physics("{\"schema\": \"1.1\"}", "f.json"); }) ==
          "f.json: 「raw_data」がありません。U3M 1.1 physics の規格を見て、書き出し直してください");
    CHECK(japanese([] { load_fabric("wool-tropicla"); }) ==
          "付属の生地に「wool-tropicla」はありません。wool-tropical "
          "のことでしょうか。または生地ファイルのパスを指定してください");
    CHECK(japanese([] { read_text_file("/none/at/all.csv"); }) ==
          "/none/at/all.csv: ファイルがありません。パスを確認してください");
    CHECK(japanese([] { find_scene("hanging"); }).starts_with("「hanging」という場面はありません。場面は "));
  }

  TEST_CASE("What the TOML library says is framed in Japanese") {
    const std::string text = japanese([] { parse_fabric("format = \n", "w.toml", "."); });
    CHECK(text.starts_with("w.toml:1:"));
    CHECK(text.find("TOML の書き方に誤りがあります (") != std::string::npos);
    CHECK(text.ends_with("TOML を直してください。ここでファイルが切れているかもしれません"));
  }

  TEST_CASE("Messages of the system within a sentence are told in Japanese") {
    CHECK(japanese(std::string("cannot write: ") + std::strerror(ENOSPC)) ==
          "書き込めません：ディスクの空きがありません");
    CHECK(japanese(std::string("cannot make the folder: ") + std::strerror(EACCES)) ==
          "フォルダを作れません：アクセス権がありません");
  }

  TEST_CASE("What is inserted stays as it is, and words among it are looked up") {
    CHECK(japanese("the * curve (warp) has no loading or no recovery branch") ==
          "*曲線 (たて) に行きか戻りがありません");
    CHECK(japanese("the stretch test D1 in weft is missing") == "引張試験 D1 (よこ) がありません");
    CHECK(japanese("'warp' has no areal mass") == "「warp」に目付がありません");  // a fabric of that name
    CHECK(japanese("'{1} <2>' is missing") == "「{1} <2>」がありません");
    CHECK(japanese("unknown direction ''") == "「」という方向 (direction)はありません");
    CHECK(japanese("cannot read the unit 'gg/cm': unknown unit 'gg/cm'") ==
          "単位「gg/cm」を読めません：「gg/cm」という単位はありません");
  }

  TEST_CASE("A sentence that is not in the table stays English, and nothing is ever empty") {
    CHECK(japanese("a sentence of tomorrow or later") == "a sentence of tomorrow or later");
    CHECK(japanese("the file does not exist any more") == "the file does not exist any more");
    const Error unknown(ErrorKind::kBadInput, "a sentence of tomorrow", {"a.csv", 3, 0, "B"},
                        "check the path");
    CHECK(error_text(unknown, Language::kJapanese) ==
          "a.csv:3: B: a sentence of tomorrow。パスを確認してください");
    CHECK(error_text_without_place(unknown, Language::kJapanese) ==
          "a sentence of tomorrow (パスを確認してください)");
    for (const ErrorSentence& sentence : error_sentences()) {
      std::string english = sentence.english;
      for (std::size_t at = english.find('*'); at != std::string::npos; at = english.find('*', at + 4))
        english.replace(at, 1, "some");
      CAPTURE(english);
      CHECK(!japanese(english).empty());
      CHECK(japanese(english) != english);
      CHECK(error_sentence(english, Language::kEnglish) == english);
    }
  }
}
