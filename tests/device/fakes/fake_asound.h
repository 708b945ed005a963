// What tests control of the library of sounds that is none.
// SPDX-License-Identifier: Apache-2.0
#pragma once

/// One output.
struct FakeSound {
  bool refuses = false;  ///< there is no output
  bool gone = false;     ///< unplugged while it plays
  int underruns = 0;     ///< still to come
  long room = 1000;      ///< samples that it takes
  long written = 0;
  int loudest = 0;  ///< sample
  bool open = false;
};

/// Exported by the library.
extern "C" FakeSound* fake_sound();
