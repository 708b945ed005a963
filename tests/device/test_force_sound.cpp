// The tone of a force: pitch, loudness, no clicks; and an output that refuses, has underruns and goes away.
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include "fakes/fake_asound.h"
#include "fakes/scoped_variable.h"
#include "fuai/core/error.h"
#include "fuai/device/force_sound.h"
#include "fuai/device/force_tone.h"

namespace {

using namespace fuai;
using fuai_test::ScopedVariable;

const std::string kLibrary = std::string(FUAI_FAKES) + "libfake_asound.so";
constexpr double kFullSample = 32767.0;

std::vector<std::int16_t> samples_of(ForceTone& tone, std::size_t count, double share) {
  std::vector<std::int16_t> samples(count);
  tone.fill(samples, share);
  return samples;
}

int rising_crossings(const std::vector<std::int16_t>& samples) {
  int count = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) count += samples[i - 1] < 0 && samples[i] >= 0 ? 1 : 0;
  return count;
}

int loudest(const std::vector<std::int16_t>& samples) {
  int most = 0;
  for (const std::int16_t sample : samples) most = std::max(most, std::abs(int{sample}));
  return most;
}

FakeSound& fake() {
  static void* handle = dlopen(kLibrary.c_str(), RTLD_NOW);
  REQUIRE(handle != nullptr);
  return *reinterpret_cast<FakeSound* (*)()>(dlsym(handle, "fake_sound"))();
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("a tone has the pitch and the loudness of its share, and is silent without force") {
    for (const double share : {0.25, 0.5, 1.0}) {
      ForceTone tone;
      samples_of(tone, kToneRate, share);  // fifty time constants: it has come there
      const std::vector<std::int16_t> second = samples_of(tone, kToneRate, share);
      CHECK(std::abs(rising_crossings(second) - tone_of(share)) <=
            1.0);  // a second begins anywhere in a turn
      // The peak falls between two samples: at most 1 - cos(pi f / rate) below, and half a step of rounding.
      const double peak = kLoudestTone * kFullSample * share;
      CHECK(loudest(second) <= peak + 0.5);
      CHECK(loudest(second) >= peak * std::cos(std::numbers::pi * kHighestTone / kToneRate) - 0.5);
    }
    CHECK(tone_of(0.0) == doctest::Approx(kLowestTone).epsilon(1e-12));
    CHECK(tone_of(1.0) == doctest::Approx(kHighestTone).epsilon(1e-12));
    ForceTone tone;
    CHECK(loudest(samples_of(tone, 1000, 0.0)) == 0);
    CHECK(loudest(samples_of(tone, 1000, std::nan(""))) == 0);
    CHECK(loudest(samples_of(tone, 4000, 7.0)) <= kLoudestTone * kFullSample + 0.5);
  }

  TEST_CASE("a force that jumps makes no click, and how the samples are cut makes no difference") {
    ForceTone tone, cut;
    std::vector<std::int16_t> all, pieces;
    for (const double share : {1.0, 0.0, 0.6, 0.1}) {
      for (const std::int16_t s : samples_of(tone, 4800, share)) all.push_back(s);
      for (const std::size_t count : {1000, 3, 3797})
        for (const std::int16_t s : samples_of(cut, count, share)) pieces.push_back(s);
    }
    CHECK(all == pieces);
    // The slope of the loudest sine, that of its rise, and two roundings.
    const double most =
        kLoudestTone * kFullSample *
            (2.0 * std::numbers::pi * kHighestTone / kToneRate + 1.0 / (kToneFollows * kToneRate)) +
        1.0;
    int jump = 0;
    for (std::size_t i = 1; i < all.size(); ++i) jump = std::max(jump, std::abs(all[i] - all[i - 1]));
    CHECK(jump <= most);
    CHECK(jump > 0.3 * most);
  }

  TEST_CASE("sound is written where there is room, goes on after an underrun, and ends when it is gone") {
    const ScopedVariable library("FUAI_ASOUND_LIBRARY", kLibrary);
    fake() = {};
    {
      ForceSound sound;
      CHECK(fake().open);
      CHECK(sound.set(1.0));
      CHECK(fake().written == 1000);
      CHECK(fake().loudest > 0);
      CHECK(sound.set(1.0));  // there is no room
      CHECK(fake().written == 1000);
      fake().room = 1000000;
      fake().underruns = 1;
      CHECK(sound.set(0.5));
      CHECK(fake().written == 1000 + 5760);  // 120 ms at most
      fake().gone = true;
      CHECK_FALSE(sound.set(0.5));
      CHECK_FALSE(fake().open);
      CHECK_FALSE(sound.set(0.5));
    }
    fake() = {};
    { const ForceSound sound; }
    CHECK_FALSE(fake().open);
  }

  TEST_CASE("no output, and no library, are one clear line") {
    const auto line = [] {
      try {
        const ForceSound sound;
      } catch (const Error& e) {
        CHECK(e.kind() == ErrorKind::kNoDevice);
        return e.problem();
      }
      return std::string();
    };
    {
      const ScopedVariable library("FUAI_ASOUND_LIBRARY", kLibrary);
      fake() = {};
      fake().refuses = true;
      CHECK(line() == "no sound: there is no output");
    }
    const ScopedVariable library("FUAI_ASOUND_LIBRARY", "/nosuch/libasound.so.2");
    CHECK(line().find("/nosuch") != std::string::npos);
    CHECK(line().find('\n') == std::string::npos);
  }
}
