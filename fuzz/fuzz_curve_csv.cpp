// Fuzzes the reader of curve files; what it accepts must be written and read again.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "fuai/core/error.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/text_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuai::MeasuredCurve curve;
  try {
    const std::string text = fuai::decode_text({reinterpret_cast<const char*>(data), size}, "fuzz.csv");
    curve = fuai::parse_curve_csv(text, "fuzz.csv");
  } catch (const fuai::Error&) {
    return 0;
  }
  fuai::curve_warnings(curve);
  // An Error that escapes from here on is a fault of ours. Branches split at turns share samples, so that a
  // second reading has as many branches as the first wrote.
  const fuai::MeasuredCurve again = fuai::parse_curve_csv(fuai::format_curve_csv(curve), "again.csv");
  if (again.branches.size() != curve.branches.size()) std::abort();
  return 0;
}
