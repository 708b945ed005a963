// Processes: what they say, how they end, how many run at once.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/runtime/processes.h"

using namespace fuai;

namespace {

ProcessWords shell(const std::string& line) { return {"/bin/sh", "-c", line}; }

std::vector<ProcessEnd> run(const std::vector<ProcessWords>& commands, int at_once) {
  std::vector<ProcessEnd> ends(commands.size());
  int count = 0;
  run_processes(commands, at_once, [&](ProcessEnd&& end) {
    ++count;
    ends.at(end.index) = std::move(end);
  });
  CHECK(count == static_cast<int>(commands.size()));
  return ends;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("output, messages, exit code and signal of each come back with its index") {
    const std::vector<ProcessWords> commands{shell("echo out; echo err >&2; exit 3"),
                                             shell("kill -9 $$"),
                                             {"/bin/echo", "two words", "a'b\"c $x"},
                                             shell("cat")};
    for (const int at_once : {1, 2, 9}) {
      const std::vector<ProcessEnd> ends = run(commands, at_once);
      CHECK(ends[0].output == "out\n");
      CHECK(ends[0].messages == "err\n");
      CHECK(ends[0].exit_code == 3);
      CHECK(ends[0].signal == 0);
      CHECK(ends[0].seconds > 0.0);
      CHECK(ends[1].exit_code == -1);
      CHECK(ends[1].signal == SIGKILL);
      CHECK(ends[2].output == "two words a'b\"c $x\n");
      CHECK(ends[2].exit_code == 0);
      CHECK(ends[3].output.empty());  // standard input is empty: `cat` ends
      CHECK(ends[3].exit_code == 0);
    }
  }

  TEST_CASE("much output on both streams neither blocks nor gets lost; messages are cut") {
    // Each stream carries more than a pipe holds (64 KiB), written one after the other.
    const std::vector<ProcessEnd> ends =
        run({shell("head -c 300000 /dev/zero | tr '\\0' e >&2; head -c 1000000 /dev/zero | tr '\\0' o")}, 1);
    CHECK(ends[0].output == std::string(1000000, 'o'));
    CHECK(ends[0].messages == std::string(kMostProcessMessages, 'e'));
  }

  TEST_CASE("one at a time they run in order; two at a time they run together") {
    std::vector<std::size_t> order;
    const std::vector<ProcessWords> commands{shell("sleep 0.05"), shell("true"), shell("true")};
    run_processes(commands, 1, [&](ProcessEnd&& end) { order.push_back(end.index); });
    CHECK(order == std::vector<std::size_t>{0, 1, 2});

    // Each of the two waits until the other has opened the same named pipe: alone it would never end.
    const std::string pipe =
        (std::filesystem::temp_directory_path() / ("fuai-test-runtime-" + std::to_string(::getpid())))
            .string();
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    const std::vector<ProcessEnd> ends = run({shell("echo met > " + pipe), shell("cat " + pipe)}, 2);
    ::unlink(pipe.c_str());
    CHECK(ends[1].output == "met\n");
  }

  TEST_CASE("a program that is not there is named") {
    const std::vector<ProcessWords> commands{{"/nonexistent/program"}};
    try {
      run_processes(commands, 1, [](ProcessEnd&&) {});
      FAIL("nothing thrown");
    } catch (const Error& e) {
      CHECK(e.kind() == ErrorKind::kCheckFailed);
      CHECK(std::string(e.what()).find("/nonexistent/program") != std::string::npos);
    }
    CHECK_THROWS_AS(run_processes(commands, 0, [](ProcessEnd&&) {}), Error);
  }

  TEST_CASE("the own program is a file that exists") {
    CHECK(own_program().find("test_runtime") != std::string::npos);
    CHECK(own_program().front() == '/');
  }
}

TEST_SUITE("safety") {
  TEST_CASE("a caller that throws leaves no process behind") {
    const std::vector<ProcessWords> commands{shell("exit 0"), {"/bin/sleep", "86400"}};
    CHECK_THROWS_AS(run_processes(commands, 2, [](ProcessEnd&&) { throw std::runtime_error("full disk"); }),
                    std::runtime_error);
    // No child is left, neither running nor waiting to be asked for.
    CHECK(::waitpid(-1, nullptr, WNOHANG) == -1);
    CHECK(errno == ECHILD);
  }
}
