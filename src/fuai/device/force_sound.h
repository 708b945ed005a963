// A tone that follows the force, by ALSA where its library is there: something to hear for people without a
// device.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "A device".
#pragma once

#include <memory>

namespace fuai {

/// The sound of the system's default output, loaded at run time from libasound.so.2 (FUAI_ASOUND_LIBRARY
/// names another file). Never waits: what it has room for is written with every set().
class ForceSound {
 public:
  /// @throws Error (kNoDevice) in the library's or the loader's words. Thread class: set-up.
  ForceSound();
  ~ForceSound();
  ForceSound(const ForceSound&) = delete;
  ForceSound& operator=(const ForceSound&) = delete;

  /// To be called with every picture. @param share as ForceTone::fill()
  /// @return false once the output is gone. Thread class: any but the force loop's: the system may wait.
  bool set(double share) noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace fuai
