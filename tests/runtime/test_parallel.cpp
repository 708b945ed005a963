// Independent tasks on a few threads.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuai/runtime/parallel.h"

TEST_SUITE("determinism") {
  TEST_CASE("every task runs once and the results do not depend on the threads") {
    std::vector<std::vector<int>> results;
    for (int threads : {0, 1, 2, 7}) {
      std::vector<int> values(50, 0);
      std::vector<std::function<void()>> tasks;
      for (std::size_t i = 0; i < values.size(); ++i)
        tasks.emplace_back([&values, i] { values[i] += static_cast<int>(i * i); });
      fuai::run_parallel(tasks, threads);
      results.push_back(values);
    }
    for (const auto& values : results) CHECK(values == results.front());
    CHECK(results.front()[7] == 49);
  }

  TEST_CASE("the first failure in the order of the tasks is thrown after all have run") {
    int ran = 0;
    const std::vector<std::function<void()>> tasks{[&] { ++ran; }, [] { throw std::runtime_error("first"); },
                                                   [] { throw std::runtime_error("second"); }};
    for (int threads : {1, 2}) {
      try {
        fuai::run_parallel(tasks, threads);
        FAIL("nothing thrown");
      } catch (const std::runtime_error& e) {
        CHECK(std::string(e.what()) == "first");
      }
    }
    CHECK(ran == 2);
  }

  TEST_CASE("no task, no work") { fuai::run_parallel({}, 2); }
}
