// What the commands that record and replay share: a scene and how to build it again, and records on their way
// to a file.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "console.h"
#include "fuai/fabric/fabric.h"
#include "fuai/haptics/session_record.h"
#include "fuai/io/session_log.h"
#include "fuai/runtime/recorder.h"
#include "fuai/scenes/catalogue.h"

namespace fuai_app {

/// Ticks of a table: some hundred MB of text.
inline constexpr std::int64_t kMostRecorded = 1'000'000;

/// A scene as the options name it.
struct SceneSetup {
  std::string scene;
  std::string fabric = "cupro-woven-su1098";
  std::string spacing;  ///< with unit; empty: the scene's own
  std::string solver = "implicit";
  std::string precision;  ///< empty: the solver's own
  int size = 0;           ///< 0: the scene's own
  int iterations = 0;     ///< 0: the solver's own
};

/// The same, built.
struct BuiltScene {
  fuai::Fabric fabric;
  fuai::EngineScene scene;
};

/// Builds it and says the fabric's warnings. @throws fuai::Error for names and sizes.
BuiltScene build_scene(const Console& console, const SceneSetup& setup);

/// What a recording begins with. @param kind "simulate" or "haptics"
fuai::SessionLogInfo begin_info(const std::string& kind, const SceneSetup& setup, const fuai::Fabric& fabric);
/// The setup of a recording. @throws fuai::Error (kBadInput).
SceneSetup scene_setup_of(const fuai::SessionLogInfo& info);
/// Warns when the fabric is not the one of the recording any more.
void check_fabric(const Console& console, const fuai::SessionLogInfo& info, const fuai::Fabric& fabric);

/// Between the records of a session and those of a file.
fuai::LogTick to_log(const fuai::TickRecord& record);
fuai::TickRecord from_log(const fuai::LogTick& tick);
fuai::LogStep to_log(const fuai::ClothStepRecord& record);
fuai::ClothStepRecord from_log(const fuai::LogStep& step);

/// What a name says about how to record.
enum class RecordForm { kNone, kTable, kLog };
/// @param path of --record. @throws fuai::Error (kUsage) for a name of neither kind, (kBadInput) when it
/// cannot be written there.
RecordForm record_form(const std::string& path);

/// A recording on its way: file, writer, thread.
class LogRecorder final : public fuai::RecordSink {
 public:
  /// @param patient the run waits for the writer; else records that find no room are lost
  LogRecorder(const std::string& path, const fuai::SessionLogInfo& info, bool patient);

  fuai::SessionListener& listener() { return recorder_; }
  /// Ends the file. @return records that were lost. @throws fuai::Error (kBadInput) when the disk is full.
  std::uint64_t finish(std::uint64_t state_hash);

  void take(std::span<const fuai::TickRecord> ticks, std::span<const fuai::ClothStepRecord> steps) override;
  void flush() override { writer_.flush(); }

 private:
  fuai::SessionLogWriter writer_;
  fuai::Recorder recorder_;  // last: its thread uses the writer
};

}  // namespace fuai_app
