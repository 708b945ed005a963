// Fuzzes the reader of U3M physics files: whatever the bytes, only fuai::Error may come out.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/io/text_file.h"
#include "fuai/io/u3m.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    fuai::parse_u3m_physics(fuai::decode_text({reinterpret_cast<const char*>(data), size}, "fuzz.json"),
                            "fuzz.json");
  } catch (const fuai::Error&) {
  }
  return 0;
}
