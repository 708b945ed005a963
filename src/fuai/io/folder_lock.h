// Keeps a second program out of a folder that one is writing results into.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace fuai {

/// Holds a folder as long as the object lives, or until the program ends in whatever way.
class FolderLock {
 public:
  /// Makes the folder where it is missing. @throws Error (kBadInput) when it cannot be made or written, and
  /// when another program holds it. Thread class: set-up.
  explicit FolderLock(const std::string& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

/// Makes a folder and those above it. @throws Error (kBadInput). Thread class: set-up.
void make_folder(const std::string& folder);

/// Removes what writes that were killed left in a folder: the temporary files of write_atomically(). Only
/// while nothing else writes there. Thread class: set-up.
void remove_temporary_files(const std::string& folder);

}  // namespace fuai
