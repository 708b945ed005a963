// The forces of all hands as CSV, a row a hand and cloth with every picture, while they act.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md, "Force log".
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "fuai/io/growing_file.h"
#include "fuai/viewer/view_session.h"

namespace fuai {

/// Writes the log. Thread class: set-up (file).
class ForceLog {
 public:
  /// Writes the heading. @throws Error (kBadInput) as GrowingFile.
  explicit ForceLog(const std::string& path);

  /// Adds a row for every hand that holds, of the user and of the scene; a snapshot that was written already
  /// is left out. @param fabrics names by cloth. @throws Error (kBadInput) as GrowingFile::add().
  void write(const ViewSnapshot& snapshot, const std::vector<std::string>& fabrics = {});

 private:
  GrowingFile file_;
  std::uint64_t build_ = 0;
  std::int64_t tick_ = -1;
};

}  // namespace fuai
