// What a test sets and sees of the fake OpenHaptics library.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai_test {

/// One fake device in the vendor's coordinates and units (mm, N).
struct FakeHdDevice {
  const char* name = "Default Device";
  const char* model = "Touch";
  double position[3] = {}, velocity[3] = {};
  double transform[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  double force[3] = {};  ///< applied, since the last end of a frame
  double pending[3] = {};
  int buttons = 0;
  unsigned calibration = 0x5000;
  int calibration_updates = 0;
  bool plugged = true, open = false, force_output = false, in_frame = false;
  int opened = 0;
};

/// The whole library.
struct FakeHd {
  FakeHdDevice devices[2];
  int count = 1;
  unsigned next_error = 0;  ///< told by the next hdGetError in a tick, once
  bool frozen = false;      ///< the scheduler's thread hangs: ticks do nothing
  bool scheduler_runs = false;
  int callbacks = 0;  ///< scheduled now
  int misuses = 0;    ///< forces outside of frames, wrong handles, openings while the scheduler runs
  unsigned long rate = 0;
};

/// `fake_hd` and `fake_hd_tick` are their names in the library; a tick is one of the scheduler's.
using FakeHdAccess = FakeHd* (*)();
using FakeHdTick = void (*)();

}  // namespace fuai_test
