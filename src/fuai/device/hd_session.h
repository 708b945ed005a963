// The one scheduler of OpenHaptics, shared by all devices of the process.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include "fuai/device/hd_api.h"
#include "fuai/device/vendor_library.h"

namespace fuai {

/// Library and scheduler. The scheduler stands still while devices are opened and closed, as the vendor asks.
class HdSession {
 public:
  /// The session of this process. @throws Error (kNoDevice) when the library cannot be used.
  /// Thread class: set-up.
  static std::shared_ptr<HdSession> get();
  /// Loads and asks, without a session. @return why the library cannot be used; empty when it can.
  /// Thread class: set-up.
  static std::string problem_of(VendorLibrary& library, HdApi& api);

  const HdApi& api() const noexcept { return api_; }
  /// Stops the scheduler's thread. Thread class: set-up.
  void pause() noexcept;
  /// Starts it again while there are devices. @param change of the number of devices. Thread class: set-up.
  void resume(int change) noexcept;
  /// The first error that is waiting, in the vendor's words with its number, empty when there is none;
  /// forgets the others. Thread class: set-up.
  std::string take_error() const;
  /// Forgets all errors that are waiting: the queue is shared by all devices. Thread class: real-time.
  void forget_errors() const noexcept;

 private:
  HdApi api_;
  int devices_ = 0;
  bool running_ = false;
};

/// Names that are tried for libHD.
std::span<const char* const> hd_library_names() noexcept;
/// What a user can do about a problem of the library.
std::string hd_library_cure(const VendorLibrary& library);

}  // namespace fuai
