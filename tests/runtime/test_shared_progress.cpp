// The progress of tasks that run side by side.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/runtime/parallel.h"
#include "fuai/runtime/shared_progress.h"

TEST_SUITE("unit") {
  TEST_CASE("what is shown is the mean of the tasks, under the name of the one that reports") {
    std::vector<double> shown;
    std::string name;
    const fuai::Progress out = [&](std::string_view what, double fraction) {
      name = what;
      shown.push_back(fraction);
    };
    fuai::SharedProgress shared(out, 4);
    const fuai::Progress first = shared.of(0, "first"), last = shared.of(3, "last");
    first("", 0.5);
    CHECK(name == "first");
    last("ignored", 1.0);
    CHECK(name == "last");
    first("", 1.0);
    CHECK(shown == std::vector<double>{0.125, 0.375, 0.5});
  }

  TEST_CASE("reports of several threads come one at a time and all arrive") {
    int inside = 0, reports = 0;
    bool alone = true;
    double last = 0.0;
    const fuai::Progress out = [&](std::string_view, double fraction) {
      alone = alone && ++inside == 1;
      ++reports;
      last = fraction;
      --inside;
    };
    fuai::SharedProgress shared(out, 8);
    std::vector<std::function<void()>> tasks;
    for (std::size_t i = 0; i < 8; ++i) {
      tasks.emplace_back([own = shared.of(i, "")] {
        for (int k = 1; k <= 100; ++k) own("", 0.01 * k);
      });
    }
    fuai::run_parallel(tasks, 4);
    CHECK(alone);
    CHECK(reports == 800);
    CHECK(last == doctest::Approx(1.0));
  }

  TEST_CASE("nobody looks: nothing is called") {
    const fuai::Progress nobody;
    fuai::SharedProgress shared(nobody, 2);
    CHECK(!shared.of(0, "a"));
  }
}
