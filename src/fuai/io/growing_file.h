// A file that grows while something happens: each piece is handed to the system at once.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace fuai {

/// An open file. What was added is there when the program is killed; only a machine that fails may lose it.
class GrowingFile {
 public:
  /// Begins the file anew. @throws Error (kBadInput) as check_can_write(). Thread class: set-up.
  explicit GrowingFile(const std::string& path);

  /// Puts text at the end. @throws Error (kBadInput) when the system does not take it. Thread class: set-up.
  void add(std::string_view text);
  const std::string& path() const noexcept { return path_; }

 private:
  struct Close {
    void operator()(std::FILE* file) const noexcept { std::fclose(file); }
  };
  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

}  // namespace fuai
