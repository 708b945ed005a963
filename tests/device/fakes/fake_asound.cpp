// Sound without ALSA: takes samples and counts them.
// SPDX-License-Identifier: Apache-2.0
#include "fake_asound.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>

extern "C" {

FakeSound* fake_sound() {
  static FakeSound sound;
  return &sound;
}

int snd_pcm_open(void** pcm, const char* /*name*/, int stream, int mode) {
  if (fake_sound()->refuses || stream != 0 || mode != 1) return -ENOENT;
  fake_sound()->open = true;
  *pcm = fake_sound();
  return 0;
}

int snd_pcm_set_params(void* /*pcm*/, int format, int access, unsigned channels, unsigned rate,
                       int /*resample*/, unsigned /*latency*/) {
  return format == 2 && access == 3 && channels == 1 && rate == 48000 ? 0 : -EINVAL;
}

long snd_pcm_avail_update(void* /*pcm*/) {
  FakeSound& sound = *fake_sound();
  if (sound.gone) return -ENODEV;
  if (sound.underruns > 0) {
    --sound.underruns;
    return -EPIPE;
  }
  return sound.room;
}

long snd_pcm_writei(void* /*pcm*/, const void* samples, unsigned long count) {
  FakeSound& sound = *fake_sound();
  const auto* values = static_cast<const std::int16_t*>(samples);
  for (unsigned long i = 0; i < count; ++i) sound.loudest = std::max(sound.loudest, std::abs(int{values[i]}));
  sound.written += static_cast<long>(count);
  sound.room -= static_cast<long>(count);
  return static_cast<long>(count);
}

int snd_pcm_recover(void* /*pcm*/, int error, int /*silent*/) { return error == -EPIPE ? 0 : error; }

int snd_pcm_close(void* /*pcm*/) {
  fake_sound()->open = false;
  return 0;
}

const char* snd_strerror(int /*error*/) { return "there is no output"; }

}  // extern "C"
