// A library with the names of OpenHaptics' HDAPI: frames, calibration, errors, a scheduler ticked by hand.
// SPDX-License-Identifier: Apache-2.0
#include "fake_hd.h"

#include <algorithm>
#include <cstring>
#include <mutex>

using fuai_test::FakeHd;
using fuai_test::FakeHdDevice;

namespace {

struct Scheduled {
  unsigned (*callback)(void*) = nullptr;
  void* context = nullptr;
};
struct ErrorInfo {
  unsigned code;
  int internal;
  unsigned device;
};

FakeHd fake;
Scheduled scheduled[4];
unsigned current = 0, error = 0;
// Held during a tick: whoever stops the scheduler waits for its end, as with the real one.
std::mutex ticking;

void misuse(unsigned code) {
  ++fake.misuses;
  if (error == 0) error = code;
}

FakeHdDevice* device(unsigned handle) {
  if (handle >= 2 || !fake.devices[handle].open) {
    misuse(0x104);
    return nullptr;
  }
  if (!fake.devices[handle].plugged) {
    if (error == 0) error = 0x302;  // communication
    return nullptr;
  }
  return &fake.devices[handle];
}

}  // namespace

extern "C" {

FakeHd* fake_hd() { return &fake; }
void fake_hd_tick() {
  const std::scoped_lock lock(ticking);
  if (!fake.scheduler_runs || fake.frozen) return;
  for (Scheduled& one : scheduled) {
    if (one.callback == nullptr) continue;
    if (one.callback(one.context) != 0) continue;
    one = {};
    --fake.callbacks;
  }
}

unsigned hdInitDevice(const char* name) {
  if (fake.scheduler_runs) misuse(0x102);
  for (int i = 0; i < fake.count; ++i) {
    FakeHdDevice& d = fake.devices[i];
    if (!d.plugged || d.open || (name != nullptr && std::strcmp(name, d.name) != 0)) continue;
    d.open = true;
    ++d.opened;
    current = static_cast<unsigned>(i);
    return current;
  }
  error = 0x300;
  return 0xFFFFFFFF;
}
void hdDisableDevice(unsigned handle) {
  if (handle >= 2) return misuse(0x104);
  FakeHdDevice& d = fake.devices[handle];
  d.open = d.force_output = d.in_frame = false;
  std::fill_n(d.force, 3, 0.0);
}
void hdMakeCurrentDevice(unsigned handle) {
  if (device(handle) != nullptr) current = handle;
}
void hdEnable(unsigned capability) {
  FakeHdDevice* const d = device(current);
  if (d == nullptr) return;
  if (capability < 0x4000 || capability > 0x4004) return misuse(0x100);
  if (capability != 0x4000) return;
  if (fake.next_error != 0) {
    error = fake.next_error;
    fake.next_error = 0;
    return;
  }
  d->force_output = true;
}
void hdBeginFrame(unsigned handle) {
  if (handle < 2) current = handle;  // also of a device that is gone
  FakeHdDevice* const d = device(handle);
  if (d == nullptr) return;
  if (d->in_frame) return misuse(0x400);
  current = handle;
  d->in_frame = true;
  std::fill_n(d->pending, 3, 0.0);
}
void hdEndFrame(unsigned handle) {
  FakeHdDevice* const d = device(handle);
  if (d == nullptr) return;
  if (!d->in_frame) return misuse(0x401);
  d->in_frame = false;
  if (d->force_output) std::copy_n(d->pending, 3, d->force);
  if (error == 0) error = fake.next_error;
  fake.next_error = 0;
}
void hdGetDoublev(unsigned name, double* values) {
  const FakeHdDevice* const d = device(current);
  if (d == nullptr) return;
  constexpr double kBox[6] = {-80, -60, -35, 80, 60, 40};
  if (name >= 0x2050 && name < 0x2100 && !d->in_frame) misuse(0x402);
  switch (name) {
    case 0x2050:
      std::copy_n(d->position, 3, values);
      return;
    case 0x2051:
      std::copy_n(d->velocity, 3, values);
      return;
    case 0x2052:
      std::copy_n(d->transform, 16, values);
      return;
    case 0x2551:
      std::copy_n(kBox, 6, values);
      return;
    case 0x2603:
      *values = 3.1;
      return;
    case 0x2604:
      *values = 0.8;
      return;
    default:
      misuse(0x100);
  }
}
void hdSetDoublev(unsigned name, const double* values) {
  FakeHdDevice* const d = device(current);
  if (d == nullptr) return;
  if (name != 0x2700) return misuse(0x100);
  if (!d->in_frame) return misuse(0x402);
  std::copy_n(values, 3, d->pending);
}
void hdGetIntegerv(unsigned name, int* values) {
  const FakeHdDevice* const d = device(current);
  if (d == nullptr) return;
  if (name == 0x2000) {
    *values = d->buttons;
  } else if (name == 0x2555) {
    *values = 4;  // inkwell
  } else {
    misuse(0x100);
  }
}
const char* hdGetString(unsigned name) {
  const FakeHdDevice* const d = device(current);
  return d != nullptr && name == 0x2501 ? d->model : nullptr;
}
ErrorInfo hdGetError() {
  const ErrorInfo told{error, error == 0 ? 0 : -7, current};
  error = 0;
  return told;
}
const char* hdGetErrorString(unsigned code) {
  return code == 0x300 ? "Device fault" : code == 0x302 ? "Communication error" : "Some other error";
}
unsigned hdCheckCalibration() {
  const FakeHdDevice* const d = device(current);
  return d != nullptr ? d->calibration : 0x5002;
}
#ifndef FAKE_HD_WITHOUT_UPDATE
void hdUpdateCalibration(unsigned style) {
  FakeHdDevice* const d = device(current);
  if (d == nullptr) return;
  if (style != 4) return misuse(0x101);
  ++d->calibration_updates;
  d->calibration = 0x5000;
}
#endif
void hdStartScheduler() {
  const std::scoped_lock lock(ticking);
  fake.scheduler_runs = true;
}
void hdStopScheduler() {
  const std::scoped_lock lock(ticking);
  fake.scheduler_runs = false;
}
void hdSetSchedulerRate(unsigned long rate) { fake.rate = rate; }
unsigned long hdScheduleAsynchronous(unsigned (*callback)(void*), void* context, unsigned short) {
  for (unsigned long i = 0; i < 4; ++i) {
    if (scheduled[i].callback != nullptr) continue;
    scheduled[i] = {callback, context};
    ++fake.callbacks;
    return i + 1;
  }
  misuse(0x501);
  return 0;
}
void hdUnschedule(unsigned long handle) {
  if (handle < 1 || handle > 4 || scheduled[handle - 1].callback == nullptr) return;
  scheduled[handle - 1] = {};
  --fake.callbacks;
}

}  // extern "C"
