// Fuzzes the reader of recordings; of what it accepts the ticks follow each other, and a table can be made.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/io/session_log.h"
#include "fuai/io/session_log_format.h"

namespace {

using namespace fuai::session_log;

void read(std::string_view bytes) {
  fuai::SessionLog log;
  try {
    log = fuai::parse_session_log(bytes, "fuzz.fuailog");
  } catch (const fuai::Error&) {
    return;
  }
  // An Error that escapes from here on is a fault of ours.
  std::uint64_t number = 0;
  for (const fuai::LogTick& tick : log.ticks) {
    if (tick.number != number && tick.number != ++number) std::abort();
    if (tick.hand >= fuai::kMostLogHands || tick.arrived > log.steps.size()) std::abort();
  }
  fuai::format_session_csv(log.ticks);
}

template <class T>
void put(std::string& bytes, std::size_t at, const T& value) {
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

/// The same with checksums, marks and numbers made right: a change of one bit is not the end of it then, and
/// what stands behind the checksums is fuzzed too.
std::string mended(std::string bytes) {
  if (bytes.size() < kHeadBytes) return bytes;
  std::uint32_t text = 0;
  std::memcpy(&text, bytes.data() + kMagic.size() + sizeof kVersion, sizeof text);
  text =
      std::min(text, static_cast<std::uint32_t>(std::min<std::size_t>(bytes.size() - kHeadBytes, kMostText)));
  bytes.replace(0, kMagic.size(), kMagic);
  put(bytes, kMagic.size(), kVersion);
  put(bytes, kMagic.size() + sizeof kVersion, text);
  put(bytes, kHeadBytes - sizeof(std::uint64_t), checksum(std::string_view(bytes).substr(kHeadBytes, text)));
  std::uint64_t number = 0;
  for (std::size_t at = kHeadBytes + text; at + fuai::kLogBlockBytes <= bytes.size();
       at += fuai::kLogBlockBytes) {
    const std::size_t sum = at + kBlockHeadBytes - sizeof(std::uint64_t);
    put(bytes, at, kBlockMark);
    put(bytes, sum - sizeof number, number++);
    put(bytes, sum, std::uint64_t{0});
    put(bytes, sum, checksum(std::string_view(bytes).substr(at, fuai::kLogBlockBytes)));
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read(bytes);
  read(mended(bytes));
  return 0;
}
