// Fuzzes the Inverse3's two readers, WebSocket frames and JSON: pieces make no difference, numbers stay sane.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "fuai/device/inverse3_wire.h"
#include "fuai/device/websocket_wire.h"

namespace {

constexpr std::string_view kHandshake =
    "HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\n"
    "Sec-WebSocket-Accept: s3pPLMBiTxaQ9kYGzzhZRbK+xOo=\r\n\r\n";

/// What a stream of bytes came to.
struct Seen {
  fuai::Inverse3State state;
  std::size_t texts = 0, pings = 0, length = 0;
  bool ended = false;
  bool operator==(const Seen& other) const {
    return state.position == other.state.position && state.velocity == other.state.velocity &&
           state.buttons == other.state.buttons && state.count == other.state.count && texts == other.texts &&
           pings == other.pings && length == other.length && ended == other.ended;
  }
};

void take(fuai::WebSocketReader& reader, std::span<const std::uint8_t> bytes, Seen& seen) {
  std::string_view message;
  while (!seen.ended) {
    const fuai::WebSocketRead read = reader.read(bytes, message);
    if (read == fuai::WebSocketRead::kNothing) return;
    seen.ended = read == fuai::WebSocketRead::kBad || read == fuai::WebSocketRead::kClose;
    if (read == fuai::WebSocketRead::kPing) ++seen.pings;
    if (read != fuai::WebSocketRead::kText) continue;
    ++seen.texts;
    seen.length += message.size();
    fuai::read_inverse3_message(message, "", seen.state);
  }
}

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

}  // namespace

/// The first byte: 0 JSON, 1 frames after a good handshake, 2 the handshake too; its rest the size of the
/// pieces.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::span<const std::uint8_t> bytes(data + 1, size - 1);
  const unsigned kind = data[0] % 3;
  Seen whole, pieces;
  if (kind == 0) {
    fuai::read_inverse3_message({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, "", whole.state);
  } else {
    const std::size_t step = 1 + data[0] / 3;
    fuai::WebSocketReader first(4096), second(4096);
    for (fuai::WebSocketReader* reader : {&first, &second}) reader->restart("s3pPLMBiTxaQ9kYGzzhZRbK+xOo=");
    if (kind == 1) take(first, bytes_of(kHandshake), whole);
    if (kind == 1) take(second, bytes_of(kHandshake), pieces);
    take(first, bytes, whole);
    for (std::size_t at = 0; at < bytes.size(); at += step)
      take(second, bytes.subspan(at, std::min(step, bytes.size() - at)), pieces);
    if (!(whole == pieces)) std::abort();
  }
  const fuai::Inverse3State& state = whole.state;
  if (!(state.position.cwiseAbs().maxCoeff() < 1000.0) || !state.orientation.allFinite()) std::abort();
  return 0;
}
