// Reads recordings, whole or torn.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "fuai/core/error.h"
#include "fuai/io/session_log_format.h"
#include "fuai/io/text_file.h"

namespace fuai {

using namespace session_log;

namespace {

[[noreturn]] void refuse(const std::string& name, const std::string& what, const std::string& cure) {
  throw Error(ErrorKind::kBadInput, what, Where{name, 0, 0, {}}, cure);
}

constexpr const char* kRecordAgain = "record the session again";

SessionLogInfo info_of(std::string_view text, const std::string& name) {
  const nlohmann::json tree = nlohmann::json::parse(text, nullptr, false);
  SessionLogInfo info;
  const auto object = [&](const char* key) {
    return tree.is_object() && tree.contains(key) && tree[key].is_object();
  };
  const auto string = [&](const char* key) {
    return tree.is_object() && tree.contains(key) && tree[key].is_string();
  };
  if (!string("program") || !string("kind") || !object("words") || !object("numbers"))
    refuse(name, "the recording's head does not say what it is of", kRecordAgain);
  info.program = tree["program"].get<std::string>();
  info.kind = tree["kind"].get<std::string>();
  for (const auto& [key, word] : tree["words"].items()) {
    if (!word.is_string()) refuse(name, "the recording's word '" + key + "' is none", kRecordAgain);
    info.words.emplace_back(key, word.get<std::string>());
  }
  for (const auto& [key, number] : tree["numbers"].items()) {
    if (!number.is_number()) refuse(name, "the recording's number '" + key + "' is none", kRecordAgain);
    info.numbers.emplace_back(key, number.get<double>());
  }
  return info;
}

/// Reads the head. @return where the blocks begin
std::size_t read_head(std::string_view bytes, const std::string& name, SessionLogInfo& info) {
  if (bytes.size() < kHeadBytes || bytes.substr(0, kMagic.size()) != kMagic)
    refuse(name, "this is no recording of a session", "give a file that --record has written");
  Take take{bytes.data() + kMagic.size()};
  std::uint32_t version = 0, size = 0;
  std::uint64_t sum = 0;
  take(version), take(size), take(sum);
  if (version != kVersion) {
    refuse(name,
           "the recording has version " + std::to_string(version) + ", this program reads version " +
               std::to_string(kVersion),
           "take the program that recorded it");
  }
  if (size > kMostText || bytes.size() - kHeadBytes < size)
    refuse(name, "the recording ends within its head: there is no tick in it", kRecordAgain);
  const std::string_view text = bytes.substr(kHeadBytes, size);
  if (checksum(text) != sum) refuse(name, "the recording's head is damaged", kRecordAgain);
  info = info_of(text, name);
  return kHeadBytes + size;
}

/// Takes a block into the log. @return whether it is as it must be
bool read_block(std::string_view bytes, std::uint64_t number, SessionLog& log) {
  BlockHead head;
  Take take{bytes.data()};
  head.fields(take);
  const std::size_t record = record_bytes(head.kind);
  if (head.mark != kBlockMark || head.number != number || record == 0 || log.end) return false;
  if (head.count == 0 || head.count > (kLogBlockBytes - kBlockHeadBytes) / record) return false;
  std::string unsummed(bytes);
  std::memset(unsummed.data() + kBlockHeadBytes - sizeof head.sum, 0, sizeof head.sum);
  if (checksum(unsummed) != head.sum) return false;
  for (std::uint16_t i = 0; i < head.count; ++i) {
    if (head.kind == kTicks) tick_fields(take, log.ticks.emplace_back());
    if (head.kind == kSteps) step_fields(take, log.steps.emplace_back());
    if (head.kind == kEnd) end_fields(take, log.end.emplace());
  }
  return true;
}

/// Whether b comes right after a: the next hand of the tick, or the first of the next tick.
bool follows(const LogTick& a, const LogTick& b) {
  return (b.number == a.number && b.hand == a.hand + 1) || (b.number == a.number + 1 && b.hand == 0);
}

/// Cuts the steps before the first gap; the ticks before the first gap, before the first that felt a step
/// that is not there (of a torn file the steps of its last blocks may be missing), and before a tick of which
/// hands are missing.
void cut_gaps(SessionLog& log) {
  std::size_t steps = 0;
  while (steps < log.steps.size() && log.steps[steps].number == steps + 1) ++steps;
  log.steps.resize(steps);
  std::vector<LogTick>& ticks = log.ticks;
  std::size_t good = 0;
  while (good < ticks.size() && ticks[good].hand < kMostLogHands && ticks[good].arrived <= steps &&
         (good == 0 ? ticks[0].number == 0 && ticks[0].hand == 0 : follows(ticks[good - 1], ticks[good])))
    ++good;
  if (good < ticks.size()) {
    if (log.damage.empty())
      log.damage = "records are missing after tick " + std::to_string(good > 0 ? ticks[good - 1].number : 0);
    log.end.reset();
  }
  ticks.resize(good);
  std::uint32_t hands = 0;
  for (const LogTick& tick : ticks) hands = std::max(hands, tick.number == 0 ? tick.hand + 1 : 0);
  if (hands == 0) return;
  // Every tick has as many hands as the first, or the recording ends before it.
  const std::size_t whole = ticks.size() / hands;
  std::size_t tick = 0;
  while (tick < whole && ticks[tick * hands].number == tick && ticks[tick * hands + hands - 1].number == tick)
    ++tick;
  ticks.resize(tick * hands);
}

}  // namespace

const std::string& SessionLogInfo::word(std::string_view key) const {
  for (const auto& [name, value] : words)
    if (name == key) return value;
  throw Error(ErrorKind::kBadInput, "the recording does not say its '" + std::string(key) + "'", {},
              kRecordAgain);
}

double SessionLogInfo::number(std::string_view key) const {
  for (const auto& [name, value] : numbers)
    if (name == key) return value;
  throw Error(ErrorKind::kBadInput, "the recording does not say its '" + std::string(key) + "'", {},
              kRecordAgain);
}

SessionLog parse_session_log(std::string_view bytes, const std::string& name) {
  SessionLog log;
  const std::size_t begin = read_head(bytes, name, log.info);
  std::string_view blocks = bytes.substr(begin);
  std::uint64_t number = 0;
  while (blocks.size() >= kLogBlockBytes && read_block(blocks.substr(0, kLogBlockBytes), number, log)) {
    blocks.remove_prefix(kLogBlockBytes);
    ++number;
  }
  if (!blocks.empty()) {
    log.damage = "the last " + std::to_string(blocks.size()) + " bytes are torn or damaged";
    log.end.reset();
  }
  cut_gaps(log);
  return log;
}

SessionLog read_session_log(const std::string& path) {
  return parse_session_log(read_bytes(path, kLargestSessionLog), path);
}

std::string format_session_csv(std::span<const LogTick> ticks) {
  std::string text =
      "tick,hand,time_s,dt_s,holds,device_time_s,device_x_m,device_y_m,device_z_m,device_vx_m_per_s,"
      "device_vy_m_per_s,device_vz_m_per_s,pinch,buttons,device_status,tool_x_m,tool_y_m,tool_z_m,force_x_N,"
      "force_y_N,force_z_N,model_force_x_N,model_force_y_N,model_force_z_N,speed_m_per_s,energy_J,model,"
      "model_age_s,gain,status\n";
  const auto real = [&](double value) {
    char number[40];
    // A cell that is no number stays empty: a device that does not measure its velocity.
    if (std::isfinite(value))
      text.append(number, static_cast<std::size_t>(std::snprintf(number, sizeof number, "%.9g", value)));
    text += ',';
  };
  const auto whole = [&](std::uint64_t value) { text += std::to_string(value) + ","; };
  const auto vector = [&](const Vec3& v) {
    for (int i = 0; i < 3; ++i) real(v[i]);
  };
  for (const LogTick& t : ticks) {
    whole(t.number), whole(t.hand), real(t.time), real(t.dt), whole(t.holds), real(t.sample_time);
    vector(t.position), vector(t.velocity), real(t.pinch), whole(t.buttons), whole(t.device_status);
    vector(t.tool), vector(t.force), vector(t.model_force), real(t.speed), real(t.energy), whole(t.model);
    real(t.model_age), real(t.gain);
    text += std::to_string(t.status) + "\n";
  }
  return text;
}

}  // namespace fuai
