// A library with the names of Force Dimension's that drives nothing and fails as it is told.
// SPDX-License-Identifier: Apache-2.0
#include "fake_dhd.h"

#include <algorithm>
#include <cmath>

using fuai_test::FakeDhd;
using fuai_test::FakeDhdDevice;

namespace {

FakeDhd fake;
const char* last_error = "no error";

int fail(const char* text) {
  last_error = text;
  return -1;
}

/// The open device of an id, or none.
FakeDhdDevice* device(char id) {
  const int i = id;
  if (i < 0 || i >= fake.count || !fake.devices[i].open) {
    ++fake.wrong_ids;
    last_error = "no device has this id";
    return nullptr;
  }
  if (!fake.devices[i].plugged) {
    last_error = "communication error";
    return nullptr;
  }
  return &fake.devices[i];
}

bool failing(unsigned call) {
  if ((fake.failing & call) == 0) return false;
  last_error = "injected error";
  return true;
}

int copy_out(const double (&from)[3], double* x, double* y, double* z) {
  *x = from[0];
  *y = from[1];
  *z = from[2];
  return fake.too_early ? 1 : 0;
}

int open_device(char index) {
  const int i = index;
  if (failing(fuai_test::kFakeDhdOpen)) return -1;
  if (i < 0 || i >= fake.count || !fake.devices[i].plugged) return fail("no device found");
  fake.devices[i].open = true;
  ++fake.devices[i].opened;
  return i;
}

int close_device(char id) {
  const int i = id;
  if (i < 0 || i >= fake.count || !fake.devices[i].open) return fail("no device has this id");
  fake.devices[i].open = fake.devices[i].forces_on = false;
  // As the device's own electronics do: without a host it gives no force.
  std::fill_n(fake.devices[i].force, 3, 0.0);
  return 0;
}

}  // namespace

extern "C" {

FakeDhd* fake_dhd() { return &fake; }

int dhdGetDeviceCount() {
  int plugged = 0;
  for (int i = 0; i < fake.count; ++i) plugged += fake.devices[i].plugged ? 1 : 0;
  if (plugged == 0) last_error = "no device found";
  return plugged;
}
const char* dhdErrorGetLastStr() { return last_error; }
void dhdGetSDKVersion(int* a, int* b, int* c, int* d) {
  *a = 3;
  *b = 17;
  *c = 6;
  *d = 0;
}
#ifdef FAKE_DHD_WITH_DRD
int drdOpenID(char index) { return open_device(index); }
int drdClose(char id) { return close_device(id); }
bool drdIsInitialized(char id) {
  const FakeDhdDevice* d = device(id);
  return d != nullptr && d->initialized;
}
#else
int dhdOpenID(char index) { return open_device(index); }
int dhdClose(char id) { return close_device(id); }
#endif
const char* dhdGetSystemName(char id) { return device(id) != nullptr ? "fake device" : nullptr; }
int dhdGetSystemType(char id) {
  const FakeDhdDevice* d = device(id);
  return d != nullptr ? d->type : -1;
}
int dhdEnableForce(unsigned char on, char id) {
  FakeDhdDevice* d = device(id);
  if (d == nullptr || failing(fuai_test::kFakeDhdEnableForce)) return -1;
  d->forces_on = on != 0;
  return 0;
}
int dhdSetGravityCompensation(int, char id) { return device(id) != nullptr ? 0 : -1; }
double dhdGetMaxForce(char id) {
  const FakeDhdDevice* d = device(id);
  return d != nullptr ? d->max_force : -1.0;
}
int dhdGetPosition(double* x, double* y, double* z, char id) {
  const FakeDhdDevice* d = device(id);
  if (d == nullptr || failing(fuai_test::kFakeDhdGetPosition)) return -1;
  return copy_out(d->position, x, y, z);
}
int dhdGetLinearVelocity(double* x, double* y, double* z, char id) {
  const FakeDhdDevice* d = device(id);
  if (d == nullptr || failing(fuai_test::kFakeDhdGetVelocity)) return -1;
  return copy_out(d->velocity, x, y, z);
}
int dhdGetOrientationFrame(double frame[3][3], char id) {
  const FakeDhdDevice* d = device(id);
  if (d == nullptr || failing(fuai_test::kFakeDhdGetOrientation)) return -1;
  std::copy_n(&d->frame[0][0], 9, &frame[0][0]);
  return 0;
}
int dhdGetGripperGap(double* gap, char id) {
  const FakeDhdDevice* d = device(id);
  if (d == nullptr || failing(fuai_test::kFakeDhdGetGripper)) return -1;
  *gap = d->gap;
  return 0;
}
unsigned dhdGetButtonMask(char id) {
  const FakeDhdDevice* d = device(id);
  return d != nullptr ? d->buttons : 0;
}
#ifndef FAKE_DHD_WITHOUT_SET_FORCE
int dhdSetForce(double x, double y, double z, char id) {
  FakeDhdDevice* d = device(id);
  if (d == nullptr || failing(fuai_test::kFakeDhdSetForce)) return -1;
  const double size = std::sqrt(x * x + y * y + z * z);
  const double share = size > fake.clips_at ? fake.clips_at / size : 1.0;
  const double given[3] = {share * x, share * y, share * z};
  std::copy_n(given, 3, d->force);
  return share < 1.0 ? 2 : 0;
}
#endif
int dhdGetStatus(int status[17], char id) {
  const FakeDhdDevice* d = device(id);
  if (d == nullptr || failing(fuai_test::kFakeDhdGetStatus)) return -1;
  std::fill_n(status, 17, 0);
  status[0] = status[1] = status[2] = 1;
  status[5] = d->forces_on && d->force_off_cause == 0 ? 1 : 0;
  status[14] = d->force_off_cause;
  return 0;
}

}  // extern "C"
