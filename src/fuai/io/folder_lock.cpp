// Keeps a second program out of a folder that one is writing results into.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <vector>

#include "fuai/core/error.h"

namespace fuai {

void make_folder(const std::string& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code && !std::filesystem::is_directory(folder)) {
    throw Error(ErrorKind::kBadInput, "cannot make the folder: " + code.message(), {folder, 0, 0, ""},
                "name another folder");
  }
}

FolderLock::FolderLock(const std::string& folder) {
  make_folder(folder);
  const std::string path = (std::filesystem::path(folder) / ".lock").string();
  descriptor_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor_ < 0) {
    throw Error(ErrorKind::kBadInput, std::string("cannot write into the folder: ") + std::strerror(errno),
                {folder, 0, 0, ""}, "check its permissions, or name another folder");
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int code = errno;
  ::close(descriptor_);
  // A file system without locks (some network ones) gives no protection, but works.
  descriptor_ = -1;
  if (code != EWOULDBLOCK) return;
  throw Error(ErrorKind::kBadInput, "another program is at work in this folder", {folder, 0, 0, ""},
              "wait until it has ended, or name another folder");
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void remove_temporary_files(const std::string& folder) {
  namespace fs = std::filesystem;
  std::error_code code;
  std::vector<fs::path> leftovers;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with('.') && name.ends_with(".tmp") && entry.is_regular_file(code))
      leftovers.push_back(entry.path());
  }
  for (const fs::path& path : leftovers) fs::remove(path, code);
}

}  // namespace fuai
