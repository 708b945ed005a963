// Writes recordings.
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "fuai/core/error.h"
#include "fuai/io/session_log_format.h"
#include "fuai/io/text_file.h"

namespace fuai {

using namespace session_log;

namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::kBadInput, what, Where{path, 0, 0, {}}, "free some space or choose another place");
}

void write_all(int file, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) refuse(path, std::string("the recording cannot go on: ") + std::strerror(errno));
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::string text_of(const SessionLogInfo& info) {
  nlohmann::ordered_json words = nlohmann::ordered_json::object(), numbers = words;
  for (const auto& [key, word] : info.words) words[key] = word;
  for (const auto& [key, number] : info.numbers) numbers[key] = number;
  nlohmann::ordered_json text;
  text["program"] = info.program;
  text["kind"] = info.kind;
  text["words"] = words;
  text["numbers"] = numbers;
  // Words may be file names in any encoding.
  return text.dump(1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace

SessionLogWriter::SessionLogWriter(const std::string& path, const SessionLogInfo& info) : path_(path) {
  const std::string text = text_of(info);
  if (text.size() > kMostText) refuse(path, "the recording's head is longer than a reader takes");
  check_can_write(path);
  file_ = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_ < 0) refuse(path, std::string("the recording cannot be opened: ") + std::strerror(errno));
  std::string head;
  Put put{head};
  head += kMagic;
  put(kVersion);
  put(static_cast<std::uint32_t>(text.size()));
  put(checksum(text));
  try {
    write_all(file_, head + text, path_);
  } catch (...) {
    ::close(file_);
    throw;
  }
}

SessionLogWriter::~SessionLogWriter() {
  if (file_ >= 0) ::close(file_);
}

void SessionLogWriter::append(const LogTick& tick) {
  Put put{ticks_.bytes};
  tick_fields(put, tick);
  ++ticks_.count;
  ++tick_count_;
  if (kBlockHeadBytes + ticks_.bytes.size() + record_bytes(kTicks) > kLogBlockBytes)
    write_block(ticks_, kTicks);
}

void SessionLogWriter::append(const LogStep& step) {
  Put put{steps_.bytes};
  step_fields(put, step);
  ++steps_.count;
  ++step_count_;
  if (kBlockHeadBytes + steps_.bytes.size() + record_bytes(kSteps) > kLogBlockBytes)
    write_block(steps_, kSteps);
}

void SessionLogWriter::write_block(Block& block, std::uint16_t kind) {
  if (block.count == 0) return;
  BlockHead head;
  head.kind = kind;
  head.count = block.count;
  head.number = blocks_++;
  const auto whole = [&] {
    std::string bytes;
    Put put{bytes};
    head.fields(put);
    bytes += block.bytes;
    bytes.resize(kLogBlockBytes, '\0');
    return bytes;
  };
  head.sum = checksum(whole());
  write_all(file_, whole(), path_);
  block = {};
}

void SessionLogWriter::flush() {
  // Steps first: a tick without the step that it felt is of no use, a step that nobody felt does no harm.
  write_block(steps_, kSteps);
  write_block(ticks_, kTicks);
}

void SessionLogWriter::finish(LogEnd end) {
  flush();
  end.ticks = tick_count_;
  end.steps = step_count_;
  Block block;
  Put put{block.bytes};
  end_fields(put, end);
  block.count = 1;
  write_block(block, kEnd);
  const bool kept = ::fsync(file_) == 0 || errno == EINVAL;  // EINVAL: no disk behind it
  const bool closed = ::close(file_) == 0;
  file_ = -1;
  if (!kept || !closed) refuse(path_, std::string("the recording cannot be kept: ") + std::strerror(errno));
}

}  // namespace fuai
