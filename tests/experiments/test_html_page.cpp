// Pages and tables.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <string>

#include "fuai/core/error.h"
#include "fuai/experiments/html_page.h"

using namespace fuai;

TEST_SUITE("unit") {
  TEST_CASE("text is escaped everywhere but in raw()") {
    HtmlPage page("a <b> & \"c\"");
    page.heading("x < y", "here");
    page.paragraph("<script>");
    page.list({"a&b"});
    page.table({{"k<"}, {{"v>"}}, "cap&"});
    page.figure("f.png", "c<", "a\"");
    page.gallery({{"g.png", "l<"}}, "cap");
    page.raw("<hr>");
    const std::string html = page.html();
    CHECK(html.find("<script>") == std::string::npos);
    CHECK(html.find("&lt;script&gt;") != std::string::npos);
    CHECK(html.find("x &lt; y") != std::string::npos);
    CHECK(html.find("alt=\"a&quot;\"") != std::string::npos);
    CHECK(html.find("<hr>") != std::string::npos);
    CHECK(html.find("<!DOCTYPE html>") == 0);
  }

  TEST_CASE("a row that does not fit its header is refused") {
    HtmlPage page("x");
    CHECK_THROWS_AS(page.table({{"a", "b"}, {{"1"}}, ""}), Error);
    CHECK_THROWS_AS(to_csv({{"a"}, {{"1", "2"}}, ""}), Error);
  }

  TEST_CASE("CSV quotes what needs it") {
    CHECK(to_csv({{"a", "b,c"}, {{"1", "say \"x\""}}, ""}) == "a,\"b,c\"\n1,\"say \"\"x\"\"\"\n");
  }
}
