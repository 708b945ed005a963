// The bytes of a recording's blocks and records: one list of fields each, for writing and for reading.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "fuai/core/hash.h"
#include "fuai/io/session_log.h"

namespace fuai::session_log {

static_assert(std::endian::native == std::endian::little, "recordings are little-endian");

inline constexpr std::string_view kMagic = "fuai-log";
inline constexpr std::uint32_t kVersion = 1;
inline constexpr std::size_t kHeadBytes = 24;            ///< before the text
inline constexpr std::uint32_t kMostText = 1 << 20;      ///< [bytes]
inline constexpr std::uint32_t kBlockMark = 0x4b4c4246;  ///< "FBLK"
inline constexpr std::size_t kBlockHeadBytes = 24;
inline constexpr std::uint16_t kTicks = 1, kSteps = 2, kEnd = 3;

/// Appends values to bytes.
struct Put {
  std::string& bytes;
  template <class T>
  void operator()(const T& value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
};

/// Takes values from bytes that are long enough: count_fits() has seen to it.
struct Take {
  const char* at;
  template <class T>
  void operator()(T& value) {
    std::memcpy(&value, at, sizeof value);
    at += sizeof value;
  }
};

/// Adds up sizes.
struct Measure {
  std::size_t size = 0;
  template <class T>
  constexpr void operator()(const T& value) {
    size += sizeof value;
  }
};

/// The fields of a tick. @param Tick LogTick, const or not
template <class Archive, class Tick>
void tick_fields(Archive& archive, Tick& t) {
  archive(t.number), archive(t.hand), archive(t.holds), archive(t.time), archive(t.dt),
      archive(t.sample_time);
  const auto vector = [&](auto& v) {
    for (int i = 0; i < v.size(); ++i) archive(v.data()[i]);
  };
  vector(t.position), vector(t.velocity), vector(t.orientation);
  archive(t.pinch), archive(t.buttons), archive(t.device_status);
  vector(t.tool), vector(t.force), vector(t.model_force);
  archive(t.speed), archive(t.energy), archive(t.model_age), archive(t.gain);
  archive(t.model), archive(t.arrived), archive(t.status), archive(t.reserved);
}
template <class Archive, class Step>
void step_fields(Archive& archive, Step& s) {
  archive(s.number), archive(s.tick), archive(s.dt), archive(s.next), archive(s.hash);
}
template <class Archive, class End>
void end_fields(Archive& archive, End& e) {
  archive(e.state_hash), archive(e.ticks), archive(e.steps), archive(e.lost);
}

/// Bytes of a record of a kind; 0 for a kind that does not exist.
inline std::size_t record_bytes(std::uint16_t kind) {
  Measure measure;
  const LogTick tick;
  const LogStep step;
  const LogEnd end;
  if (kind == kTicks) tick_fields(measure, tick);
  if (kind == kSteps) step_fields(measure, step);
  if (kind == kEnd) end_fields(measure, end);
  return measure.size;
}

inline std::uint64_t checksum(std::string_view bytes) {
  StateHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.value();
}

/// What stands before a block's records.
struct BlockHead {
  std::uint32_t mark = kBlockMark;
  std::uint16_t kind = 0, count = 0;
  std::uint64_t number = 0, sum = 0;
  template <class Archive>
  void fields(Archive& archive) {
    archive(mark), archive(kind), archive(count), archive(number), archive(sum);
  }
};

}  // namespace fuai::session_log
