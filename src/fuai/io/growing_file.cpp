// Adds to a file.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/growing_file.h"

#include <cerrno>
#include <cstring>

#include "fuai/core/error.h"
#include "fuai/io/text_file.h"

namespace fuai {
namespace {

[[noreturn]] void refuse(const std::string& path) {
  throw Error(ErrorKind::kBadInput, std::string("cannot write: ") + std::strerror(errno), {path, 0, 0, {}},
              "free some space or choose another place");
}

}  // namespace

GrowingFile::GrowingFile(const std::string& path) : path_(path) {
  check_can_write(path);
  file_.reset(std::fopen(path.c_str(), "wbe"));
  if (!file_) refuse(path_);
}

void GrowingFile::add(std::string_view text) {
  const bool written = std::fwrite(text.data(), 1, text.size(), file_.get()) == text.size();
  if (!written || std::fflush(file_.get()) != 0) refuse(path_);
}

}  // namespace fuai
