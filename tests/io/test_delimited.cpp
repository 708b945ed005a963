// Splitting tables into cells: separators, quotes, numbers, places, limits.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <string>
#include <vector>

#include "fuai/io/delimited.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;

namespace {

std::string message_of(const std::string& text) {
  return error_of([&] { parse_delimited(text, "t.csv"); }).what();
}

std::string in_quotes(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + "\"";
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("cells keep line and column; comments and blank lines are set aside") {
    const DelimitedText table = parse_delimited("# note\n\na, b ,c\n1,,\"x,\"\"y\"\"\"\n", "t.csv");
    CHECK(table.separator == ',');
    REQUIRE(table.rows.size() == 2);
    REQUIRE(table.comments.size() == 1);
    CHECK(table.comments[0].text == "note");
    CHECK(table.rows[0][1].text == "b");
    CHECK(table.rows[0][1].line == 3);
    CHECK(table.rows[0][1].column == 4);
    REQUIRE(table.rows[1].size() == 3);
    CHECK(table.rows[1][1].text.empty());
    CHECK(table.rows[1][2].text == "x,\"y\"");
    CHECK(table.rows[1][2].line == 4);
    CHECK(table.rows[1][2].column == 4);
  }

  TEST_CASE("a line break inside quotes belongs to the cell, and the count of lines goes on") {
    const DelimitedText table = parse_delimited("\"a\nb\",c\nd,e", "t.csv");
    REQUIRE(table.rows.size() == 2);
    CHECK(table.rows[0][0].text == "a\nb");
    CHECK(table.rows[1][0].line == 3);
  }

  TEST_CASE("the separator is the one that most lines hold") {
    CHECK(parse_delimited("a;b\n1,5;2,5\n", "t").separator == ';');
    CHECK(parse_delimited("a\tb\n1,5\t2,5\n", "t").separator == '\t');
    CHECK(parse_delimited("a,b\nx; y,1\nz; w,2\n", "t").separator == ',');
    CHECK(parse_delimited("\"a;b\",c\n1,2\n", "t").separator == ',');
    CHECK(parse_delimited("single\n1\n", "t").separator == ',');
  }

  TEST_CASE("numbers, with decimal commas only where they cannot separate") {
    const DelimitedText semicolons = parse_delimited("1,5;-2.5e-3;+3;1.234,5;abc;nan;1e999\n;x\n", "t.csv");
    const auto number = [&](std::size_t i) { return cell_number(semicolons, semicolons.rows[0][i], "key"); };
    CHECK(number(0) == 1.5);
    CHECK(number(1) == -2.5e-3);
    CHECK(number(2) == 3.0);
    CHECK(contains(error_of([&] { number(3); }).what(), "t.csv:1:16: key: '1.234,5' is not a number"));
    CHECK(contains(error_of([&] { number(4); }).what(), "'abc' is not a number"));
    CHECK(contains(error_of([&] { number(5); }).what(), "'nan' is not a finite number"));
    CHECK(contains(error_of([&] { number(6); }).what(), "'1e999' is not a finite number"));
    const DelimitedText commas = parse_delimited("\"1,5\",2\n", "t.csv");
    CHECK(contains(error_of([&] { cell_number(commas, commas.rows[0][0], "key"); }).what(),
                   "decimal commas need"));
  }

  TEST_CASE("broken tables are refused with their place") {
    CHECK(contains(message_of("a,b\n1,\"open\n2,3\n"), "t.csv:2:3: the quote that opens here never closes"));
    CHECK(contains(message_of("a,b\n\"1\"x,2\n"), "t.csv:2:4: there is text behind the closing quote"));
    CHECK(contains(message_of("\n# only\n  \n"), "no line of data"));
    CHECK(contains(message_of("a,b\n" + std::string(kLongestLine + 1, '1') + "\n"),
                   "t.csv:2:1: the line is longer"));
    CHECK(contains(message_of(std::string(kMostCells, ',')), "more than 1024 cells"));
  }
}

TEST_SUITE("property") {
  TEST_CASE("what is quoted comes back, whatever it is") {
    CHECK(rc::check("round trip", [](const std::vector<std::string>& words) {
      std::string line;
      std::vector<std::string> expected;
      for (const std::string& word : words) {
        std::string inside;
        for (const char c : word) inside += c == '\0' || c == '\r' || c == '\t' || c == ' ' ? '_' : c;
        line += in_quotes(inside) + ",";
        expected.push_back(inside);
      }
      RC_PRE(line.size() < static_cast<std::size_t>(kLongestLine));
      const DelimitedText table = parse_delimited(line + "end", "t");
      RC_ASSERT(table.separator == ',');
      RC_ASSERT(table.rows.size() == 1u);
      RC_ASSERT(table.rows[0].size() == expected.size() + 1);
      for (std::size_t i = 0; i < expected.size(); ++i) RC_ASSERT(table.rows[0][i].text == expected[i]);
    }));
  }
}
