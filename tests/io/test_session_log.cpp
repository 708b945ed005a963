// Recordings: what is written is read to the last bit, and of a torn or spoilt file the good part.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>

#include "fuai/io/session_log.h"
#include "fuai/io/session_log_format.h"
#include "fuai/io/text_file.h"
#include "io_test_tools.h"

using namespace fuai;
using fuai::test::TemporaryFolder;

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

SessionLogInfo info() {
  return {"fuai 1",
          "haptics",
          {{"scene", "a \"scene\"\nand more"}, {"fabric", ""}},
          {{"third", 1.0 / 3.0}, {"size", 9}}};
}

/// A tick in which every field has a value of its own.
LogTick tick_of(std::uint64_t number, std::uint32_t hand) {
  LogTick t;
  double next = 0.1 + static_cast<double>(number);
  const auto real = [&] { return next *= 1.0 + 1.0 / 3.0; };
  t.number = number;
  t.hand = hand;
  t.holds = 1;
  for (double* value : {&t.time, &t.dt, &t.sample_time, &t.pinch, &t.speed, &t.energy, &t.model_age, &t.gain})
    *value = real();
  for (Vec3* v : {&t.position, &t.velocity, &t.tool, &t.force, &t.model_force})
    *v = Vec3(real(), real(), real());
  t.orientation = Mat3::Constant(real());
  t.orientation(2, 1) = -0.0;
  t.buttons = 5;
  t.device_status = 6;
  t.model = number;
  t.arrived = number;
  t.status = 7;
  if (number % 3 == 1) t.velocity = Vec3::Constant(kNan);
  return t;
}

LogStep step_of(std::uint64_t number) {
  return {number, number, 1e-3 / static_cast<double>(number), 2e-3, number % 5 == 0 ? 0xdeadbeefULL : 0};
}

std::string bits(const LogTick& tick) {
  std::string bytes;
  session_log::Put put{bytes};
  session_log::tick_fields(put, tick);
  return bytes;
}

/// Ticks 0 to count - 1 of `hands` hands, a step with each but the first, a flush after each `flush` ticks.
std::string written(const TemporaryFolder& folder, int count, std::uint32_t hands = 1, int flush = 1000,
                    bool finish = true) {
  const std::string path = folder / "a.fuailog";
  SessionLogWriter writer(path, info());
  for (int i = 0; i < count; ++i) {
    const auto number = static_cast<std::uint64_t>(i);
    if (i > 0) writer.append(step_of(number));
    for (std::uint32_t hand = 0; hand < hands; ++hand) writer.append(tick_of(number, hand));
    if (i % flush == flush - 1) writer.flush();
  }
  if (finish) {
    writer.finish({42, 0, 0, 0});
  } else {
    writer.flush();
  }
  return read_bytes(path);
}

std::string problem(const std::string& bytes) {
  return fuai::test::error_of([&] { parse_session_log(bytes, "x.fuailog"); }).problem();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("what is written is read to the last bit") {
    const TemporaryFolder folder;
    for (std::uint32_t hands : {1U, 2U}) {
      const SessionLog log = parse_session_log(written(folder, 200, hands, 70), "x");
      CHECK(log.damage.empty());
      CHECK(log.info.program == "fuai 1");
      CHECK(log.info.kind == "haptics");
      CHECK(log.info.word("scene") == "a \"scene\"\nand more");
      CHECK(log.info.number("third") == 1.0 / 3.0);
      CHECK_THROWS_AS(log.info.number("scene"), Error);
      REQUIRE(log.ticks.size() == 200 * hands);
      for (std::size_t i = 0; i < log.ticks.size(); ++i)
        CHECK(bits(log.ticks[i]) == bits(tick_of(i / hands, static_cast<std::uint32_t>(i % hands))));
      REQUIRE(log.steps.size() == 199);
      CHECK(log.steps[4].hash == 0xdeadbeefULL);
      CHECK(log.steps[4].dt == 1e-3 / 5.0);
      REQUIRE(log.end);
      CHECK(log.end->state_hash == 42);
      CHECK(log.end->ticks == 200 * hands);
      CHECK(log.end->steps == 199);
    }
  }

  TEST_CASE("the table has a row a tick, and no cell that is no number") {
    const TemporaryFolder folder;
    const SessionLog log = parse_session_log(written(folder, 5), "x");
    const std::string text = format_session_csv(log.ticks);
    CHECK(std::count(text.begin(), text.end(), '\n') == 6);
    CHECK(text.find("nan") == std::string::npos);
    const std::size_t head = text.find('\n');
    const auto commas = [&](std::size_t from, std::size_t to) {
      return std::count(text.begin() + static_cast<std::ptrdiff_t>(from),
                        text.begin() + static_cast<std::ptrdiff_t>(to), ',');
    };
    for (std::size_t line = head + 1; line < text.size(); line = text.find('\n', line) + 1)
      CHECK(commas(line, text.find('\n', line)) == commas(0, head));
  }
}

TEST_SUITE("safety") {
  TEST_CASE("a file that ends anywhere gives the ticks of its whole blocks") {
    const TemporaryFolder folder;
    // Blocks of 10 ticks and their steps.
    const std::string whole = written(folder, 60, 1, 10, false);
    REQUIRE(parse_session_log(whole, "x").ticks.size() == 60);
    std::size_t last = 0;
    for (std::size_t size = whole.size() % kLogBlockBytes; size <= whole.size(); size += 997) {
      const SessionLog log = parse_session_log(whole.substr(0, size), "x");
      const std::size_t blocks = (size - whole.size() % kLogBlockBytes) / kLogBlockBytes;
      // Steps come first, so every second block brings ten ticks.
      CHECK(log.ticks.size() == blocks / 2 * 10);
      CHECK(log.damage.empty() == ((size - whole.size() % kLogBlockBytes) % kLogBlockBytes == 0));
      CHECK(!log.end);
      CHECK(log.ticks.size() >= last);
      last = log.ticks.size();
    }
  }

  TEST_CASE("a wrong bit anywhere is found: the head is refused, of the blocks those before it are taken") {
    const TemporaryFolder folder;
    const std::string whole = written(folder, 30, 1, 10);
    const std::size_t head = whole.size() % kLogBlockBytes;
    for (std::size_t at = 0; at < whole.size(); at += at < head ? 1 : 613) {
      std::string spoilt = whole;
      spoilt[at] = static_cast<char>(spoilt[at] ^ 0x10);
      CAPTURE(at);
      if (at < head) {
        // A text one byte shorter or longer does not have its checksum either.
        CHECK_THROWS_AS(parse_session_log(spoilt, "x"), Error);
        continue;
      }
      const SessionLog log = parse_session_log(spoilt, "x");
      CHECK(log.ticks.size() == (at - head) / kLogBlockBytes / 2 * 10);
      CHECK(!log.damage.empty());
      CHECK(!log.end);
    }
  }

  TEST_CASE("a gap ends the ticks, and a tick is taken with all of its hands and steps or not at all") {
    const TemporaryFolder folder;
    const std::string path = folder / "b.fuailog";
    const auto read = [&](const auto& fill) {
      SessionLogWriter writer(path, info());
      fill(writer);
      writer.finish({});
      return read_session_log(path);
    };
    const auto ticks_with = [&](std::initializer_list<std::uint64_t> numbers, std::uint64_t steps) {
      return read([&](SessionLogWriter& writer) {
        for (std::uint64_t i = 1; i <= steps; ++i) writer.append(step_of(i));
        for (std::uint64_t number : numbers)
          for (std::uint32_t hand = 0; hand < 2; ++hand) writer.append(tick_of(number, hand));
      });
    };
    CHECK(ticks_with({0, 1, 2, 3}, 3).ticks.size() == 8);
    CHECK(ticks_with({0, 1, 3}, 3).ticks.size() == 4);
    CHECK(ticks_with({0, 1, 3}, 3).damage.find("after tick 1") != std::string::npos);
    CHECK(!ticks_with({0, 1, 3}, 3).end);
    CHECK(ticks_with({1, 2}, 3).ticks.empty());
    // Tick 2 felt step 2, which is not there.
    CHECK(ticks_with({0, 1, 2, 3}, 1).ticks.size() == 4);
    const SessionLog half = read([&](SessionLogWriter& writer) {
      writer.append(tick_of(0, 0));
      writer.append(tick_of(0, 1));
      writer.append(step_of(1));
      writer.append(tick_of(1, 0));
    });
    CHECK(half.ticks.size() == 2);
    const SessionLog absurd = read([&](SessionLogWriter& writer) {
      LogTick tick = tick_of(0, 0);
      tick.hand = 1U << 30;
      writer.append(tick);
    });
    CHECK(absurd.ticks.empty());
  }

  TEST_CASE("what is no recording is refused in words") {
    const TemporaryFolder folder;
    const std::string whole = written(folder, 3);
    CHECK(problem("hello").find("this is no recording") != std::string::npos);
    CHECK(problem("").find("this is no recording") != std::string::npos);
    CHECK(problem(whole.substr(0, 60)).find("ends within its head") != std::string::npos);
    std::string other = whole;
    other[8] = 9;
    CHECK(problem(other).find("version 9") != std::string::npos);
    std::string huge = whole;
    std::memset(huge.data() + 12, 0xff, 4);
    CHECK(problem(huge).find("ends within its head") != std::string::npos);
    CHECK_THROWS_AS(SessionLogWriter(folder.path(), info()), Error);
    CHECK_THROWS_AS(SessionLogWriter(folder / "no/such/folder.fuailog", info()), Error);
  }
}
