// Fuzzes the reader of KES sheets; each fabric that it accepts must be written as a fabric file and read
// again.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/kes_sheet.h"
#include "fuai/io/text_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<fuai::Fabric> fabrics;
  try {
    fabrics = fuai::parse_kes_sheet(
        fuai::decode_text({reinterpret_cast<const char*>(data), size}, "fuzz.csv"), "fuzz.csv");
  } catch (const fuai::Error&) {
    return 0;
  }
  for (const fuai::Fabric& fabric : fabrics) {
    fuai::parse_fabric(fuai::format_fabric(fabric), "again.toml", "/nonexistent");
  }
  return 0;
}
