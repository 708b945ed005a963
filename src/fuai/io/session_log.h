// Recordings of sessions: a record a tick and one a step of the cloth, in blocks that keep a torn tail apart.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/theory/force-path.md, "Recording".
//
//   "fuai-log" | u32 version | u32 bytes of the text | u64 checksum of the text | text (JSON: SessionLogInfo)
//   block* :   u32 kBlockMark | u16 kind | u16 records | u64 number | u64 checksum | records | zeros
//
//   Every block has kLogBlockBytes. Its checksum is FNV-1a over the block with the checksum's place zero; its
//   number counts from 0. Little-endian, IEEE doubles. The reader takes whole blocks until the first that is
//   not as it must be, and says what it left.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "fuai/core/types.h"

namespace fuai {

inline constexpr std::size_t kLogBlockBytes = 16384;
/// Largest recording that is read [bytes]: three hours at 1 kHz.
inline constexpr std::uint64_t kLargestSessionLog = 4ULL * 1024 * 1024 * 1024;
/// Hands of a recording are numbered below this.
inline constexpr std::uint32_t kMostLogHands = 16;

/// What the recording is of: everything that is needed to build the run again.
struct SessionLogInfo {
  std::string program;  ///< "fuai 0.1.0"
  std::string kind;     ///< "simulate" or "haptics"
  std::vector<std::pair<std::string, std::string>> words{};
  std::vector<std::pair<std::string, double>> numbers{};  ///< finite; kept to the last bit

  /// @throws Error (kBadInput) when there is none. Thread class: any.
  const std::string& word(std::string_view key) const;
  double number(std::string_view key) const;
};

/// A tick of one hand. What the fields are: TickRecord and DeviceSample.
struct LogTick {
  std::uint64_t number = 0;
  std::uint32_t hand = 0, holds = 0;
  double time = 0.0, dt = 0.0;                            ///< [s]
  double sample_time = 0.0;                               ///< [s]
  Vec3 position = Vec3::Zero(), velocity = Vec3::Zero();  ///< of the device [m], [m/s]
  Mat3 orientation = Mat3::Identity();
  double pinch = 0.0;
  std::uint32_t buttons = 0, device_status = 0;
  Vec3 tool = Vec3::Zero();                                       ///< [m]
  Vec3 force = Vec3::Zero(), model_force = Vec3::Zero();          ///< [N]
  double speed = 0.0, energy = 0.0, model_age = 0.0, gain = 0.0;  ///< [m/s], [J], [s]
  std::uint64_t model = 0, arrived = 0;
  std::uint32_t status = 0, reserved = 0;
};

/// A step of the cloth. What the fields are: ClothStepRecord.
struct LogStep {
  std::uint64_t number = 0, tick = 0;
  double dt = 0.0, next = 0.0;  ///< [s]
  std::uint64_t hash = 0;       ///< of the state after it; 0: not taken
};

/// Written last, when the session ended by itself.
struct LogEnd {
  std::uint64_t state_hash = 0;
  std::uint64_t ticks = 0, steps = 0;  ///< records written
  std::uint64_t lost = 0;              ///< records that found no room
};

/// A recording.
struct SessionLog {
  SessionLogInfo info;
  std::vector<LogTick> ticks;
  std::vector<LogStep> steps;
  std::optional<LogEnd> end;  ///< none: the session was cut off
  std::string damage;         ///< what was left out, a sentence without a full stop; empty: nothing
};

/// Reads what is whole. Ticks end before the first gap.
/// @throws Error (kBadInput) when the file cannot be read, is no recording, of another version, or its head
/// is damaged. Thread class: set-up.
SessionLog read_session_log(const std::string& path);
/// The same from bytes. @param name file name for messages
SessionLog parse_session_log(std::string_view bytes, const std::string& name);

/// All ticks as CSV in SI units, with a header. Thread class: set-up.
std::string format_session_csv(std::span<const LogTick> ticks);

/// Writes a recording as it comes.
class SessionLogWriter {
 public:
  /// Makes the file anew, or empties it, and writes its head.
  /// @throws Error (kBadInput) as check_can_write(), or when the disk is full. Thread class: set-up.
  SessionLogWriter(const std::string& path, const SessionLogInfo& info);
  ~SessionLogWriter();
  SessionLogWriter(const SessionLogWriter&) = delete;
  SessionLogWriter& operator=(const SessionLogWriter&) = delete;

  /// Full blocks are written at once. @throws Error (kBadInput) when the disk is full. Thread class: any, one
  /// at a time.
  void append(const LogTick& tick);
  void append(const LogStep& step);
  /// Writes what there is, full or not: the system has it then, whatever becomes of the process.
  void flush();
  /// The last block, and on to the disk. Counts of `end` are filled in.
  void finish(LogEnd end);

 private:
  struct Block {
    std::string bytes;
    std::uint16_t count = 0;
  };
  void write_block(Block& block, std::uint16_t kind);

  std::string path_;
  int file_ = -1;
  Block ticks_, steps_;
  std::uint64_t blocks_ = 0, tick_count_ = 0, step_count_ = 0;
};

}  // namespace fuai
