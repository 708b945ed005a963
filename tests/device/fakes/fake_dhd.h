// What a test sets and sees of the fake Force Dimension library.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai_test {

/// Calls that can be made to fail.
enum FakeDhdCall : unsigned {
  kFakeDhdOpen = 1,
  kFakeDhdEnableForce = 2,
  kFakeDhdGetPosition = 4,
  kFakeDhdGetVelocity = 8,
  kFakeDhdSetForce = 16,
  kFakeDhdGetStatus = 32,
  kFakeDhdGetOrientation = 64,
  kFakeDhdGetGripper = 128
};

/// One fake device in the vendor's coordinates.
struct FakeDhdDevice {
  int type = 33;
  double position[3] = {}, velocity[3] = {}, force[3] = {};
  double frame[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double gap = 0.025, max_force = -1.0;
  unsigned buttons = 0;
  bool plugged = true, open = false, forces_on = false, initialized = true;
  int force_off_cause = 0;
  int opened = 0;  ///< how often
};

/// The whole library.
struct FakeDhd {
  FakeDhdDevice devices[2];
  int count = 1;
  unsigned failing = 0;    ///< FakeDhdCall bits: these calls return -1
  bool too_early = false;  ///< positions are those of the last call, with 1 (time guard)
  double clips_at = 1e9;   ///< set_force beyond it gives this much and returns 2 [N]
  int wrong_ids = 0;       ///< calls with an id that is not open
};

/// The one of the loaded fake; `fake_dhd` is its name in the library.
using FakeDhdAccess = FakeDhd* (*)();

}  // namespace fuai_test
