// The paper's page: its quick parts.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <set>
#include <string>

#include "fuai/core/error.h"
#include "fuai/experiments/paper_page.h"

using namespace fuai;

TEST_SUITE("unit+slow") {
  TEST_CASE("figure 1: every picture the page names is there, and threads do not change a byte") {
    double last = 0.0;
    bool grows = true;
    const PaperPage one = make_paper_page({1, 1}, [&](std::string_view, double f) {
      grows = grows && f >= last;
      last = f;
    });
    CHECK(grows);
    CHECK(last == doctest::Approx(1.0));
    const PaperPage two = make_paper_page({1, 2}, {});
    REQUIRE(one.files.size() == two.files.size());
    std::set<std::string> names;
    std::string html;
    for (std::size_t i = 0; i < one.files.size(); ++i) {
      CHECK(one.files[i].name == two.files[i].name);
      CHECK(one.files[i].bytes == two.files[i].bytes);
      names.insert(one.files[i].name);
      if (one.files[i].name == "index.html") html = one.files[i].bytes;
    }
    int pictures = 0;
    for (std::size_t at = html.find("src=\""); at != std::string::npos; at = html.find("src=\"", at + 1)) {
      const std::string name = html.substr(at + 5, html.find('"', at + 5) - at - 5);
      CAPTURE(name);
      CHECK(names.contains(name));
      ++pictures;
    }
    CHECK(pictures == 4);
  }

  TEST_CASE("a figure that does not exist is refused") {
    CHECK_THROWS_AS(make_paper_page({2, 1}, {}), Error);
  }
}
