// Reads the manifest of a batch (fuai-batch/1): which commands, fabrics and settings make its cases.
// SPDX-License-Identifier: Apache-2.0
//
//   format = "fuai-batch/1"
//   fabrics = ["wool-tropical", "mine/linen.fabric.toml"]   # of every [[cases]] that names none itself
//   [[cases]]
//   command = "drape"
//   spacing = ["10mm", "5mm"]     # an option without its dashes; a list: a case for each
//   elastic = [false, true]       # a flag
//   variants = [{ disc = "18cm", specimen = "30cm" }, { disc = "12.7cm", specimen = "25.4cm" }]
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fuai/core/error.h"

namespace fuai {

/// What a setting can be.
struct BatchValue {
  enum class Kind { kText, kNumber, kBoolean };

  Kind kind = Kind::kText;
  std::vector<std::string> words;  ///< as on a command line; several for a list within a list
  bool boolean = false;            ///< of kBoolean
  Where where;
};

/// One key and every value that it takes, at least one.
struct BatchSetting {
  std::string name;
  std::vector<BatchValue> values;
  Where where;
};

/// One [[cases]].
struct BatchBlock {
  std::string command;
  Where where;                                      ///< of the command
  std::vector<BatchValue> fabrics;                  ///< its own or the manifest's; may be none
  std::vector<BatchSetting> settings;               ///< in the order of the file
  std::vector<std::vector<BatchSetting>> variants;  ///< settings that belong together; one value each
};

/// A manifest.
struct BatchManifest {
  std::string path;
  std::vector<BatchBlock> blocks;  ///< at least one
};

/// Largest manifest that is read [bytes].
inline constexpr std::uint64_t kLargestManifest = 1024ULL * 1024;

/// Reads a manifest. What commands and settings there are it does not know: see make_batch_cases().
/// @throws Error (kBadInput) with file, line, column, key and cure. Thread class: set-up.
BatchManifest read_batch_manifest(const std::string& path);

/// The same from the text of a file. @param path for messages, and where relative paths of fabrics begin
BatchManifest parse_batch_manifest(std::string_view text, const std::string& path);

}  // namespace fuai
