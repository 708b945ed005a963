// Fuzzes the VRPN client: whatever a server sends, all numbers stay finite, and pieces make no difference.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "fuai/device/vrpn_client.h"

namespace {

bool same(const fuai::VrpnState& a, const fuai::VrpnState& b) {
  return a.position == b.position && a.orientation == b.orientation && a.buttons == b.buttons &&
         a.force_error == b.force_error && a.poses == b.poses && a.knows_device == b.knows_device &&
         a.knows_forces == b.knows_forces && a.pose_count == b.pose_count &&
         a.message_count == b.message_count;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t step = 1 + data[0] % 64;  // the first byte says how large the pieces are
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  fuai::VrpnClient whole("Phantom0"), pieces("Phantom0");
  whole.collect_names();
  const bool good = whole.take(bytes);
  bool still = true;
  for (std::size_t at = 0; at < bytes.size() && still; at += step)
    still = pieces.take(bytes.subspan(at, std::min(step, bytes.size() - at)));
  if (good != still || !same(whole.state(), pieces.state())) std::abort();
  if (!whole.state().position.allFinite() || !whole.state().orientation.allFinite()) std::abort();
  if (whole.names().size() > 64) std::abort();
  return 0;
}
