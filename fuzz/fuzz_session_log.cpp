// Fuzzes the reader of recordings; of what it accepts the ticks follow each other, and a table can be made.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/io/session_log.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuai::SessionLog log;
  try {
    log = fuai::parse_session_log({reinterpret_cast<const char*>(data), size}, "fuzz.fuailog");
  } catch (const fuai::Error&) {
    return 0;
  }
  // An Error that escapes from here on is a fault of ours.
  std::uint64_t number = 0;
  for (const fuai::LogTick& tick : log.ticks) {
    if (tick.number != number && tick.number != ++number) std::abort();
    if (tick.hand >= fuai::kMostLogHands || tick.arrived > log.steps.size()) std::abort();
  }
  fuai::format_session_csv(log.ticks);
  return 0;
}
