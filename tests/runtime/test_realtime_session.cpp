// The session in real time, by clocks that are computed: what it does does not depend on the machine's pace.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/realtime_session.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <limits>
#include <mutex>
#include <thread>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/device/device_simulated.h"
#include "fuai/haptics/session_replay.h"
#include "fuai/runtime/interrupt.h"
#include "fuai/runtime/recorder.h"
#include "support/allocation_guard.h"
#include "support/lock_guard.h"

using namespace fuai;

namespace {

/// Time passes in sleeping only, and sleeping only lets the other thread run: both race as fast as they can.
class RacingClock final : public SessionClock {
 public:
  double now() noexcept override { return time_; }
  void sleep_until(double time) noexcept override {
    time_ = std::max(time_, time) + (++sleeps_ == late_sleep ? lateness : 0.0);
    if (sleeps_ % yields_every == 0) std::this_thread::yield();
    if (pause.count() > 0) std::this_thread::sleep_for(pause);
  }
  std::uint64_t yields_every = 1;      ///< handing over costs more than a tick where cores are scarce
  std::chrono::microseconds pause{0};  ///< really sleeps so long
  std::uint64_t late_sleep = 0;        ///< this one wakes late
  double lateness = 0.0;               ///< [s]

 private:
  double time_ = 100.0;
  std::uint64_t sleeps_ = 0;
};

/// Keeps everything; each list belongs to one thread.
class Keeper final : public SessionListener {
 public:
  explicit Keeper(std::size_t room) {
    ticks.reserve(room);
    steps.reserve(room);
  }
  void on_tick(const TickRecord& record) noexcept override { ticks.push_back(record); }
  void on_step(const ClothStepRecord& record) noexcept override { steps.push_back(record); }
  std::vector<TickRecord> ticks;
  std::vector<ClothStepRecord> steps;
};

/// A computed device that remembers its last command.
class Watched final : public Device {
 public:
  Watched() : device_(find_device_preset("premium"), find_hand_model("arm"), motion()) {}
  const DeviceInfo& info() const noexcept override { return device_.info(); }
  DeviceSample read() noexcept override { return device_.read(); }
  void write(const DeviceCommand& command) noexcept override {
    last = command.force;
    device_.write(command);
  }
  void advance(double dt) noexcept override { device_.advance(dt); }
  Vec3 last = Vec3::Zero();

 private:
  static std::unique_ptr<const HandMotion> motion() {
    return make_chirp_motion(Vec3::Zero(), Vec3(0.02, 0.0, 0.01), {0.0, 2000.0}, 0.5, 0.6);
  }
  SimulatedDevice device_;
};

SpringWall make_wall() { return {200.0, 1.0, Vec3(0.005, 0.0, 0.0), SpringWall::Answer::kTangent}; }

/// One hand on a wall.
struct Trial {
  RealtimeReport run(const RealtimeOptions& options, SessionListener* listener,
                     const std::atomic<bool>& stop = never()) {
    const SessionHand hand{&device, &path};
    RealtimeSession session({&hand, 1}, wall, options, nullptr, listener);
    return session.run(force_clock, cloth_clock, stop);
  }
  static const std::atomic<bool>& never() {
    static const std::atomic<bool> flag{false};
    return flag;
  }
  Watched device;
  ForcePath path{make_force_path_options(device.info())};
  SpringWall wall = make_wall();
  RacingClock force_clock, cloth_clock;
};

RealtimeOptions options_of(std::int64_t ticks) {
  RealtimeOptions options;
  options.ticks = ticks;
  options.claim = false;  // racing threads before all others would shut the machine out
  return options;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("lateness falls into octaves of a microsecond") {
    CHECK(lateness_bin(-1.0) == 0);
    CHECK(lateness_bin(0.9e-6) == 0);
    CHECK(lateness_bin(1.5e-6) == 1);
    CHECK(lateness_bin(1e9) == kLatenessBins - 1);
    CHECK(std::isinf(lateness_bound(kLatenessBins - 1)));
    for (std::size_t bin = 0; bin + 1 < kLatenessBins; ++bin) {
      CHECK(lateness_bin(lateness_bound(bin) * 0.99) == bin);
      CHECK(lateness_bin(lateness_bound(bin) * 1.01) == bin + 1);
    }
  }

  TEST_CASE(
      "a tick that wakes late is one tick with its true dt; what was missed is counted, not made up for") {
    Trial trial;
    Keeper keeper(100);
    trial.force_clock.late_sleep = 10;
    trial.force_clock.lateness = 3.5e-3;
    const RealtimeReport report = trial.run(options_of(50), &keeper);
    CHECK(report.ticks == 50);
    CHECK(report.overruns == 3);
    CHECK(report.worst_lateness == doctest::Approx(3.5e-3));
    CHECK(report.lateness[lateness_bin(3.5e-3)] == 1);
    REQUIRE(keeper.ticks.size() == 50);
    CHECK(keeper.ticks[9].dt == doctest::Approx(4.5e-3));
    // The next tick is due at its old place: half a tick later.
    CHECK(keeper.ticks[10].dt == doctest::Approx(0.5e-3));
    CHECK(keeper.ticks[11].dt == doctest::Approx(1e-3));
    CHECK(keeper.ticks.back().time == doctest::Approx(53e-3));
    CHECK(trial.path.counters().late == 0);
  }

  TEST_CASE("options that make no sense are refused") {
    Trial trial;
    const SessionHand hand{&trial.device, &trial.path};
    const auto refused = [&](const auto& change) {
      RealtimeOptions options = options_of(1);
      change(options);
      CHECK_THROWS_AS(RealtimeSession({&hand, 1}, trial.wall, options), Error);
    };
    refused([](RealtimeOptions& o) { o.tick = 0.0; });
    refused([](RealtimeOptions& o) { o.tick = std::numeric_limits<double>::quiet_NaN(); });
    refused([](RealtimeOptions& o) { o.cloth_period = 0.5e-3; });
    refused([](RealtimeOptions& o) { o.longest_step = 0.5e-3; });
    refused([](RealtimeOptions& o) { o.ticks = -1; });
    CHECK_THROWS_AS(RealtimeSession({}, trial.wall, options_of(1)), Error);
  }
}

TEST_SUITE("safety") {
  TEST_CASE("a signal ends the session, and the last thing written is no force") {
    Trial trial;
    const InterruptFlag interrupt;
    /// Sends the signal from within the force loop once there is force.
    class Interrupter final : public SessionListener {
     public:
      void on_tick(const TickRecord& record) noexcept override {
        if (record.tick.force.norm() <= 0.1 || sent) return;
        sent = true;
        // A terminal and whoever started the program may both pass it on: the second one, within the same
        // tick, must not end the process with force on the hand.
        for (const int number : {SIGINT, SIGINT, SIGTERM, SIGHUP}) std::raise(number);
      }
      void on_step(const ClothStepRecord& /*record*/) noexcept override {}
      bool sent = false;
    } interrupter;
    const RealtimeReport report = trial.run(options_of(0), &interrupter, interrupt.flag());
    CHECK(interrupter.sent);
    CHECK(report.ticks > 0);
    CHECK(trial.device.last == Vec3::Zero());
  }

  TEST_CASE("a cloth that never answers gives no force, and does not keep the session from ending") {
    /// Answers nothing that is a model.
    class Mute final : public HapticEnvironment {
     public:
      LocalModel update(const ToolPose& /*pose*/, double /*dt*/, double /*next*/) noexcept override {
        LocalModel model;
        model.force = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
        model.number = ++number_;
        return model;
      }

     private:
      std::uint64_t number_ = 0;
    } mute;
    std::size_t answers = 0;  // a busy machine may give the cloth's thread no turn in a run
    for (int run = 0; run < 200 && answers == 0; ++run) {
      Trial trial;
      Keeper keeper(2000);
      const SessionHand hand{&trial.device, &trial.path};
      RealtimeSession session({&hand, 1}, mute, options_of(2000), nullptr, &keeper);
      session.run(trial.force_clock, trial.cloth_clock, Trial::never());
      for (const TickRecord& record : keeper.ticks) CHECK(record.tick.force == Vec3::Zero());
      CHECK(keeper.ticks.size() == 2000);
      answers += trial.path.counters().models;
    }
    CHECK(answers > 0);
  }
}

TEST_SUITE("realtime") {
  TEST_CASE(
      "two racing threads: no pose or model is torn, for the replay of all that was told has the same bits") {
    // A torn pose or model has numbers of two moments, and its force other bits than the whole one's. Under
    // the thread sanitizer the same run proves that nothing is shared but by mailbox.
    // How often they meet is the machine's affair: a busy one may give the cloth's thread hardly a turn in
    // twenty thousand ticks.
    constexpr std::size_t kMeetings = 100;
    constexpr int kMostRuns = 200;
    std::size_t meetings = 0;
    double largest = 0.0;
    for (int run = 0; run < kMostRuns && (meetings <= kMeetings || largest <= 0.3); ++run) {
      Trial trial;
      Keeper keeper(20'000);
      const RealtimeReport report = trial.run(options_of(20'000), &keeper);
      CHECK(report.ticks == 20'000);
      CHECK(report.cloth_steps == keeper.steps.size());
      meetings += keeper.steps.size();
      Trial again;
      ForcePath* path = &again.path;
      const ReplayResult result = replay_session({&path, 1}, again.wall, keeper.ticks, keeper.steps);
      CHECK(result.matches());
      CHECK(result.ticks == 20'000);
      for (const TickRecord& record : keeper.ticks) largest = std::max(largest, record.tick.force.norm());
    }
    CHECK(meetings > kMeetings);
    CHECK(largest > 0.3);
  }

  TEST_CASE("no allocation and no lock in a million ticks, recorded; in the cloth's steps neither") {
    /// Allocations and locks of each thread, from its first record on; and the records go to a recorder.
    class Counter final : public SessionListener {
     public:
      struct Count {
        std::size_t allocations = fuai_test::allocation_count(), locks = fuai_test::lock_count();
      };
      explicit Counter(Recorder& next) : next_(next) {}
      void on_tick(const TickRecord& record) noexcept override {
        if (record.number == 0) ticks_before = {};
        ticks_after = {};
        next_.on_tick(record);
      }
      void on_step(const ClothStepRecord& record) noexcept override {
        if (record.number == 1) steps_before = {};
        steps_after = {};
        next_.on_step(record);
      }
      Count ticks_before, ticks_after, steps_before, steps_after;

     private:
      Recorder& next_;
    };
    /// Throws everything away.
    class Bin final : public RecordSink {
     public:
      void take(std::span<const TickRecord> some_ticks, std::span<const ClothStepRecord> /*steps*/) override {
        ticks += some_ticks.size();
      }
      void flush() override {}
      std::uint64_t ticks = 0;
    } bin;
    Trial trial;
    trial.force_clock.yields_every = 1000;
    trial.cloth_clock.pause = std::chrono::microseconds(200);
    Recorder recorder(bin, 4096, false);
    Counter counter(recorder);
    const RealtimeReport report = trial.run(options_of(1'000'000), &counter);
    recorder.finish();
    CHECK(report.ticks == 1'000'000);
    CHECK(counter.ticks_after.allocations == counter.ticks_before.allocations);
    CHECK(counter.ticks_after.locks == counter.ticks_before.locks);
    CHECK(counter.steps_after.allocations == counter.steps_before.allocations);
    CHECK(counter.steps_after.locks == counter.steps_before.locks);
    // Who takes a lock is seen.
    std::mutex mutex;
    const fuai_test::LockGuard guard;
    { const std::lock_guard lock(mutex); }
    CHECK(guard.count() == (fuai_test::counts_locks() ? 1 : 0));
    CHECK(report.cloth_steps > 0);
    CHECK(bin.ticks > 0);
  }
}
