// Writes the tone to ALSA.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/force_sound.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <string>

#include "fuai/core/error.h"
#include "fuai/device/force_tone.h"
#include "fuai/device/vendor_library.h"

namespace fuai {
namespace {

constexpr std::array kNames{"libasound.so.2"};
constexpr const char* kCure = "install libasound2 and see that `aplay` is heard";
// Of <alsa/pcm.h>, whose numbers are part of its binary interface.
constexpr int kPlayback = 0, kNonBlocking = 1, kSigned16 = 2, kInterleaved = 3, kResample = 1;
/// What waits to be heard: longer than a picture of a quick driver, shorter than an ear minds [us].
constexpr unsigned kLatency_us = 120000;
constexpr std::size_t kPiece = 480;  // samples at a time

/// It writes to standard error otherwise.
void be_silent(const char* /*file*/, int /*line*/, const char* /*function*/, int /*error*/,
               const char* /*format*/, ...) {}

}  // namespace

struct ForceSound::Parts {
  VendorLibrary library{"FUAI_ASOUND_LIBRARY", kNames};
  int (*open)(void** pcm, const char* name, int stream, int mode) = nullptr;
  int (*set_params)(void* pcm, int format, int access, unsigned channels, unsigned rate, int resample,
                    unsigned latency) = nullptr;
  long (*room)(void* pcm) = nullptr;
  long (*write)(void* pcm, const void* samples, unsigned long count) = nullptr;
  int (*recover)(void* pcm, int error, int silent) = nullptr;
  int (*close)(void* pcm) = nullptr;
  const char* (*words)(int error) = nullptr;
  int (*set_handler)(decltype(&be_silent)) = nullptr;
  void* pcm = nullptr;
  ForceTone tone;

  void find_all() {
    library.find("snd_pcm_open", open);
    library.find("snd_pcm_set_params", set_params);
    library.find("snd_pcm_avail_update", room);
    library.find("snd_pcm_writei", write);
    library.find("snd_pcm_recover", recover);
    library.find("snd_pcm_close", close);
    library.find("snd_strerror", words);
    if (library.find_optional("snd_lib_error_set_handler", set_handler)) set_handler(be_silent);
  }
  [[noreturn]] static void refuse(const std::string& why) {
    throw Error(ErrorKind::kNoDevice, "no sound: " + why, {"", 0, 0, "sound"}, kCure);
  }
  void end() noexcept {
    if (pcm != nullptr) close(pcm);
    pcm = nullptr;
  }
};

ForceSound::ForceSound() : parts_(std::make_unique<Parts>()) {
  Parts& p = *parts_;
  if (p.library.loaded()) p.find_all();
  if (!p.library.loaded()) Parts::refuse(p.library.findings().back().found);
  if (const std::string problem = p.library.problem(); !problem.empty()) Parts::refuse(problem);
  int error = p.open(&p.pcm, "default", kPlayback, kNonBlocking);
  if (error < 0) {
    p.pcm = nullptr;
    Parts::refuse(p.words(error));
  }
  error = p.set_params(p.pcm, kSigned16, kInterleaved, 1, kToneRate, kResample, kLatency_us);
  if (error >= 0) return;
  p.end();
  Parts::refuse(p.words(error));
}

ForceSound::~ForceSound() { parts_->end(); }

bool ForceSound::set(double share) noexcept {
  Parts& p = *parts_;
  if (p.pcm == nullptr) return false;
  std::array<std::int16_t, kPiece> samples;
  // As much as fits in the latency at most, so that an output which always has room ends, too.
  long left = static_cast<long>(kToneRate) * kLatency_us / 1000000;
  while (left > 0) {
    long room = p.room(p.pcm);
    // An underrun: the picture took longer than the latency.
    if (room < 0 && p.recover(p.pcm, static_cast<int>(room), 1) >= 0) room = p.room(p.pcm);
    if (room < 0) {
      p.end();
      return false;
    }
    const long count = std::min({room, left, static_cast<long>(kPiece)});
    if (count == 0) break;
    p.tone.fill({samples.data(), static_cast<std::size_t>(count)}, share);
    const long done = p.write(p.pcm, samples.data(), static_cast<unsigned long>(count));
    if (done == -EAGAIN) break;
    if (done < 0 && p.recover(p.pcm, static_cast<int>(done), 1) < 0) {
      p.end();
      return false;
    }
    left -= count;
  }
  return true;
}

}  // namespace fuai
