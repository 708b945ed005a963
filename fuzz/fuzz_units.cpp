// Fuzzes the reader of units and of values with units.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/io/kes_header.h"
#include "fuai/units/parse.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    fuai::parse_unit(text);
  } catch (const fuai::Error&) {
  }
  try {
    if (std::isnan(fuai::parse_value(text, fuai::kLength, "fuzz"))) std::abort();
  } catch (const fuai::Error&) {
  }
  try {
    fuai::read_sheet_header(text);
  } catch (const fuai::Error&) {
  }
  return 0;
}
