// Manifests of a batch, case files and their tables, the folder's lock.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "fuai/io/batch_manifest.h"
#include "fuai/io/case_record.h"
#include "fuai/io/delimited.h"
#include "fuai/io/folder_lock.h"
#include "fuai/io/text_file.h"
#include "fuai/io/toml_tree.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;
using fuai::test::TemporaryFolder;

namespace {

const std::string kManifest = R"(format = "fuai-batch/1"
fabrics = ["wool-tropical", "a/b.fabric.toml"]
[[cases]]
command = "drape"
spacing = ["10mm", "5mm"]
runs = 2
elastic = [false, true]
variants = [{ disc = "18cm", specimen = "30cm" }, { disc = "12.7cm", specimen = "25.4cm" }]
[[cases]]
command = "kes"
fabrics = "graded-1"
test = "bending"
reverse = [["1", "1.5:0.5"], 2.25]
)";

BatchManifest parse(const std::string& text) { return parse_batch_manifest(text, "m.toml"); }

std::string with(const std::string& from, const std::string& to) {
  std::string text = kManifest;
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from);
  return text.replace(at, from.size(), to);
}

CaseRecord sample(const std::string& id) {
  CaseRecord record;
  record.id = id;
  record.version = "1.2.3";
  record.words = {"--json", "drape", "wool \"tropical\""};
  record.input_hash = "0123";
  record.settings = {{"fabric", "wool, \"tropical\""}, {"spacing", "5mm"}};
  record.seconds = 1.5;
  record.result = R"({"a":{"mean":0.1,"each":[1,2.5]},"notes":["x, y","z"],"no":null,"flag":true})";
  return record;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("TOML values come with their kinds and places") {
    const TomlNode root =
        parse_toml("a = 1\nb = [1.5, 'x',\n  true]\n[t]\n\"k.l\" = { c = 2020-01-01 }\n", "f");
    using Kind = TomlNode::Kind;
    CHECK(root.kind == Kind::kTable);
    REQUIRE(root.find("a") != nullptr);
    CHECK(root.find("a")->kind == Kind::kInteger);
    CHECK(root.find("a")->integer == 1);
    CHECK(root.find("a")->number == 1.0);
    const TomlNode& list = *root.find("b");
    REQUIRE(list.items.size() == 3);
    CHECK(list.items[0].number == 1.5);
    CHECK(list.items[1].text == "x");
    CHECK((list.items[2].boolean && list.items[2].line == 3 && list.items[2].column == 3));
    const TomlNode* inner = root.find("t")->find("k.l");
    REQUIRE(inner != nullptr);
    CHECK(inner->find("c")->kind == Kind::kDate);
    CHECK((root.members[2].key == "t" && root.members[2].value.members[0].line == 5));
    CHECK(root.find("none") == nullptr);
    const Error error = error_of([] { parse_toml("a = 1\nb = [", "f.toml"); });
    CHECK((error.where().file == "f.toml" && error.where().line == 2));
  }

  TEST_CASE("a manifest keeps the order of the file, and values keep their kind") {
    const BatchManifest manifest = parse(kManifest);
    REQUIRE(manifest.blocks.size() == 2);
    const BatchBlock& drape = manifest.blocks[0];
    CHECK((drape.command == "drape" && drape.where.line == 4 && drape.where.key == "cases[0].command"));
    REQUIRE(drape.fabrics.size() == 2);
    CHECK(drape.fabrics[1].words == std::vector<std::string>{"a/b.fabric.toml"});
    REQUIRE(drape.settings.size() == 3);
    CHECK((drape.settings[0].name == "spacing" && drape.settings[0].values.size() == 2));
    CHECK(drape.settings[1].values[0].kind == BatchValue::Kind::kNumber);
    CHECK(drape.settings[1].values[0].words == std::vector<std::string>{"2"});
    CHECK((!drape.settings[2].values[0].boolean && drape.settings[2].values[1].boolean));
    REQUIRE(drape.variants.size() == 2);
    CHECK((drape.variants[1][0].name == "disc" && drape.variants[1][1].values[0].words[0] == "25.4cm"));
    const BatchBlock& kes = manifest.blocks[1];
    CHECK((kes.fabrics.size() == 1 && kes.fabrics[0].words[0] == "graded-1"));
    REQUIRE(kes.settings[1].values.size() == 2);
    CHECK(kes.settings[1].values[0].words == std::vector<std::string>{"1", "1.5:0.5"});
    CHECK(kes.settings[1].values[1].words == std::vector<std::string>{"2.25"});
  }

  TEST_CASE("a wrong manifest is refused with its place and what would be right") {
    struct Wrong {
      std::string from, to;
      int line;
      std::string key, says;
    };
    const std::vector<Wrong> all{
        {"fuai-batch/1", "fuai-batch/2", 1, "format", "write format = \"fuai-batch/1\""},
        {"fabrics = [\"wool", "fabric = [\"wool", 2, "fabric", "the nearest known key is fabrics"},
        {"[[cases]]\ncommand = \"drape\"", "[cases]\ncommand = \"drape\"", 9, "", ""},
        {"command = \"drape\"", "comand = \"drape\"", 3, "cases[0].command", "write command ="},
        {"[\"10mm\", \"5mm\"]", "[]", 5, "cases[0].spacing", "the list is empty"},
        {"[\"10mm\", \"5mm\"]", "nan", 5, "cases[0].spacing", "not finite"},
        {"[\"10mm\", \"5mm\"]", "{ a = 1 }", 5, "cases[0].spacing", "a text, a number"},
        {"runs = 2", "runs = 2020-01-01", 6, "cases[0].runs", "a text, a number"},
        {"{ disc = \"18cm\", specimen = \"30cm\" }", "3", 8, "cases[0].variants", "a table is expected"},
        {"disc = \"18cm\"", "disc = [\"18cm\", \"1cm\"]", 8, "cases[0].variants.disc", "one value"},
        {"runs = 2", "disc = \"1cm\"", 8, "cases[0].variants.disc", "and beside them"},
        {"\"graded-1\"", "3", 11, "cases[1].fabrics", "a fabric is a text"},
        {"\"bending\"", "[\"bending\", ]]", 12, "", ""},
    };
    for (const Wrong& wrong : all) {
      CAPTURE(wrong.to);
      const Error error = error_of([&] { parse(with(wrong.from, wrong.to)); });
      CHECK(error.where().file == "m.toml");
      CHECK(error.where().line == wrong.line);
      CHECK(error.where().key == wrong.key);
      CHECK_MESSAGE(contains(error.what(), wrong.says), error.what());
    }
    CHECK(contains(error_of([] { parse("format = \"fuai-batch/1\"\n"); }).what(), "there are no cases"));
    CHECK(contains(error_of([] { parse("fabrics = []\n"); }).what(), "'format' is missing"));
  }

  TEST_CASE("a case file comes back; whatever is cut off or changed in its frame does not") {
    CaseRecord record = sample("drape-1");
    record.exit_code = 1;
    record.messages = "fuai: \xff no UTF-8\n";
    const std::string text = format_case(record);
    const std::optional<CaseRecord> back = parse_case(text);
    REQUIRE(back.has_value());
    CHECK((back->id == record.id && back->version == record.version && back->words == record.words));
    CHECK((back->settings == record.settings && back->result == record.result && back->seconds == 1.5));
    CHECK((back->exit_code == 1 && back->signal == 0 && back->input_hash == "0123"));
    CHECK(format_case(*back) == text);
    for (std::size_t length = 0; length + 1 < text.size(); ++length)
      CHECK_FALSE(parse_case(text.substr(0, length)).has_value());
    for (const char* broken :
         {"{}", "[]", "null", R"({"format":"fuai-case/1"})", R"({"format":"fuai-case/2"})"})
      CHECK_FALSE(parse_case(broken).has_value());
    CHECK_FALSE(parse_case(std::string(100000, '[')).has_value());
    CHECK(is_json_object("{\"a\": 1}\n"));
    for (const char* no : {"", "1", "[1]", "{} {}", "{\"a\": nan}"}) CHECK_FALSE(is_json_object(no));
  }

  TEST_CASE("the tables hold a row a case and the columns of all") {
    CaseRecord other = sample("kes-2");
    other.settings = {{"fabric", "b"}, {"test", "bending"}};
    other.exit_code = 3;
    other.result.clear();
    other.messages = "fuai: bad\nfile";
    const std::vector<CaseRecord> records{sample("drape-1"), other};
    const DelimitedText table = parse_delimited(format_results_csv(records), "r.csv");
    REQUIRE(table.rows.size() == 3);
    std::vector<std::string> columns, first, second;
    for (const DelimitedCell& cell : table.rows[0]) columns.push_back(cell.text);
    for (const DelimitedCell& cell : table.rows[1]) first.push_back(cell.text);
    for (const DelimitedCell& cell : table.rows[2]) second.push_back(cell.text);
    CHECK(columns == std::vector<std::string>{"case", "command", "setting.fabric", "setting.test",
                                              "setting.spacing", "exit_code", "signal", "wall_seconds",
                                              "message", "a.mean", "a.each.0", "a.each.1", "notes", "no",
                                              "flag"});
    CHECK(first == std::vector<std::string>{"drape-1", "fuai --json drape wool \"tropical\"",
                                            "wool, \"tropical\"", "", "5mm", "0", "0", "1.5", "", "0.1", "1",
                                            "2.5", "x, y | z", "", "true"});
    REQUIRE(second.size() == columns.size());
    CHECK(
        (second[3] == "bending" && second[5] == "3" && second[8] == "fuai: bad\nfile" && second[9].empty()));
    const std::string json = format_results_json(records, "m.toml");
    CHECK((is_json_object(json) && contains(json, R"("failed":1)") && contains(json, R"("result":null)")));
  }

  TEST_CASE("a folder is held by one at a time; leftovers of killed writes go, other files stay") {
    const TemporaryFolder folder;
    const std::string held = folder / "a/b";
    {
      const FolderLock lock(held);
      CHECK(contains(error_of([&] { const FolderLock second(held); }).what(), "at work in this folder"));
    }
    const FolderLock again(held);
    folder.write("a/b/.x.json.12.0.tmp", "half");
    folder.write("a/b/x.json", "whole");
    remove_temporary_files(held);
    CHECK_FALSE(std::filesystem::exists(held + "/.x.json.12.0.tmp"));
    CHECK(read_bytes(held + "/x.json") == "whole");
    CHECK(contains(error_of([&] { const FolderLock file(held + "/x.json"); }).what(),
                   "cannot make the folder"));
  }
}
