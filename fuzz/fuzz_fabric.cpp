// Fuzzes the reader of fabric files; what it accepts must be written and read again, with the same text.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/text_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parse = [](std::string_view text) {
    return fuai::parse_fabric(text, "fuzz.toml", "/nonexistent");
  };
  fuai::Fabric fabric;
  try {
    fabric = parse(fuai::decode_text({reinterpret_cast<const char*>(data), size}, "fuzz.toml"));
  } catch (const fuai::Error&) {
    return 0;
  }
  const std::string text = fuai::format_fabric(fabric);
  if (fuai::format_fabric(parse(text)) != text) std::abort();
  return 0;
}
