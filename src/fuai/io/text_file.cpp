// Reads whole text files as UTF-8 and writes files whole or not at all.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/text_file.h"

#include <fcntl.h>
#include <iconv.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

namespace fuai {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& cure) {
  throw Error(ErrorKind::kBadInput, what, Where{path, 0, 0, {}}, cure);
}

/// Closes a file descriptor at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  int number() const { return number_; }
  /// Closes now; false when the system reports a late write error.
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// Length of the valid UTF-8 sequence at the start of the text, 0 when there is none (RFC 3629, table 3-7 of
/// the Unicode standard: no overlong forms, no surrogates, nothing beyond U+10FFFF).
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto follows = [&](std::size_t i, unsigned low, unsigned high) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1, 0x80, 0xBF) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    const bool second = follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && follows(2, 0x80, 0xBF) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool second = follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
    return second && follows(2, 0x80, 0xBF) && follows(3, 0x80, 0xBF) ? 4 : 0;
  }
  return 0;
}

/// Offset of the first byte that is not UTF-8, or the size of the text.
std::size_t first_invalid_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t length = utf8_length(text.substr(at));
    if (length == 0) return at;
    at += length;
  }
  return at;
}

/// CP932 to UTF-8; false when the bytes are not CP932.
bool convert_cp932(std::string_view bytes, std::string& utf8) {
  struct Close {
    void operator()(void* handle) const { iconv_close(handle); }
  };
  const iconv_t handle = iconv_open("UTF-8", "CP932");
  const bool opened = reinterpret_cast<std::intptr_t>(handle) != -1;
  if (!opened) return false;
  const std::unique_ptr<void, Close> closer(handle);
  utf8.assign(bytes.size() * 3, '\0');  // two bytes of CP932 become at most three of UTF-8, one at most three
  std::string input(bytes);             // iconv takes a pointer to non-const
  char* in = input.data();
  char* out = utf8.data();
  std::size_t in_left = input.size(), out_left = utf8.size();
  if (iconv(handle, &in, &in_left, &out, &out_left) == static_cast<std::size_t>(-1)) return false;
  utf8.resize(utf8.size() - out_left);
  return true;
}

/// "\r\n" and "\r" become "\n".
void normalise_line_ends(std::string& text) {
  std::size_t to = 0;
  for (std::size_t from = 0; from < text.size(); ++from) {
    const bool crlf = text[from] == '\r' && from + 1 < text.size() && text[from + 1] == '\n';
    if (crlf) ++from;
    text[to++] = text[from] == '\r' ? '\n' : text[from];
  }
  text.resize(to);
}

void write_all(int descriptor, std::string_view bytes, const std::string& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0)
      refuse(path, std::string("cannot write: ") + std::strerror(errno),
             "free some space or choose another place");
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

std::filesystem::path folder_of(const std::filesystem::path& file) {
  return file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
}

/// The file that a write to `path` replaces: links are followed; only regular files may be replaced, and the
/// folder must exist.
std::filesystem::path target_of(const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code code;
  if (path.empty()) refuse("", "the name of the file to write is empty", "give the name of a file");
  if (!fs::is_directory(folder_of(path), code))
    refuse(path, "the folder '" + folder_of(path).string() + "' does not exist", "make the folder first");
  const fs::file_status status = fs::status(path, code);
  if (fs::is_directory(status)) refuse(path, "this is a directory", "give the name of a file");
  if (!fs::exists(status)) return path;
  if (!fs::is_regular_file(status)) refuse(path, "this is not a regular file", "give the name of a file");
  fs::path target = fs::canonical(path, code);
  if (code) refuse(path, "the path cannot be followed: " + code.message(), "choose another place");
  return target;
}

/// A file written whole under a temporary name beside its target; removed again unless committed.
class StagedFile {
 public:
  StagedFile(std::string path, std::string_view bytes) : path_(std::move(path)), target_(target_of(path_)) {
    static std::atomic<unsigned> counter{0};
    const std::filesystem::path temporary =
        folder() / ("." + target_.filename().string() + "." + std::to_string(::getpid()) + "." +
                    std::to_string(counter.fetch_add(1)) + ".tmp");
    Descriptor file(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (file.number() < 0)
      refuse(path_, std::string("cannot write into the folder: ") + std::strerror(errno),
             "check its permissions");
    temporary_.reset(new std::filesystem::path(temporary));
    struct stat old {};
    if (::stat(target_.c_str(), &old) == 0 && ::fchmod(file.number(), old.st_mode & 07777) != 0)
      refuse(path_, std::string("cannot set the permissions: ") + std::strerror(errno), {});
    write_all(file.number(), bytes, path_);
    if (::fsync(file.number()) != 0 || !file.close())
      refuse(path_, std::string("cannot write: ") + std::strerror(errno),
             "free some space or choose another place");
  }

  /// One step from the old file to the new one.
  void commit() {
    if (::rename(temporary_->c_str(), target_.c_str()) != 0)
      refuse(path_, std::string("cannot replace the file: ") + std::strerror(errno), "check its permissions");
    delete temporary_.release();
    const Descriptor directory(::open(folder().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory.number() >= 0) ::fsync(directory.number());  // the name; a failure loses nothing written
  }

 private:
  struct Remove {
    void operator()(std::filesystem::path* name) const {
      ::unlink(name->c_str());
      delete name;
    }
  };

  std::filesystem::path folder() const { return folder_of(target_); }

  std::string path_;
  std::filesystem::path target_;
  std::unique_ptr<std::filesystem::path, Remove> temporary_;
};

}  // namespace

Where place_of(std::string_view bytes, std::size_t offset, const std::string& name) {
  const std::string_view before = bytes.substr(0, offset);
  const auto line = std::count(before.begin(), before.end(), '\n') + 1;
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 == 0
  return {name, static_cast<int>(line), static_cast<int>(offset - line_start) + 1, {}};
}

std::string read_bytes(const std::string& path, std::uint64_t limit) {
  // O_NONBLOCK: opening a pipe without a writer must not hang; it is refused just below.
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (file.number() < 0 && (errno == ENOENT || errno == ENOTDIR))
    refuse(path, "the file does not exist", "check the path");
  if (file.number() < 0)
    refuse(path, std::string("the file cannot be opened: ") + std::strerror(errno),
           "check the path and its permissions");
  struct stat info {};
  if (::fstat(file.number(), &info) != 0)
    refuse(path, std::string("the file cannot be examined: ") + std::strerror(errno), {});
  if (S_ISDIR(info.st_mode)) refuse(path, "this is a directory, not a file", "give one of the files in it");
  if (!S_ISREG(info.st_mode)) refuse(path, "this is not a regular file", "copy the data into a file first");
  const auto size = static_cast<std::uint64_t>(info.st_size);
  if (size == 0) refuse(path, "the file is empty", "check that it was saved or copied completely");
  if (size > limit) {
    refuse(path,
           "the file has " + std::to_string(size) + " bytes, more than the limit of " + std::to_string(limit),
           "measurements are far smaller: check that this is the right file");
  }
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::read(file.number(), bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) refuse(path, std::string("the file cannot be read: ") + std::strerror(errno), {});
    if (count == 0) break;  // the file became shorter meanwhile
    done += static_cast<std::size_t>(count);
  }
  bytes.resize(done);
  return bytes;
}

std::string decode_text(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF"))
    refuse(name, "this is UTF-16 text", "save the file as UTF-8");
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (bytes.empty()) refuse(name, "the file is empty", "check that it was saved or copied completely");
  if (const std::size_t nul = bytes.find('\0'); nul != std::string_view::npos) {
    throw Error(ErrorKind::kBadInput, "there is a NUL byte: this is a binary file, not text",
                place_of(bytes, nul, name), "export the data as text (CSV, TOML or JSON)");
  }
  std::string text;
  const std::size_t invalid = first_invalid_utf8(bytes);
  if (invalid == bytes.size()) {
    text = bytes;
  } else if (!convert_cp932(bytes, text)) {
    throw Error(ErrorKind::kBadInput, "the text is neither UTF-8 nor CP932 (Shift-JIS)",
                place_of(bytes, invalid, name), "save the file as UTF-8");
  }
  normalise_line_ends(text);
  return text;
}

std::string read_text_file(const std::string& path, std::uint64_t limit) {
  return decode_text(read_bytes(path, limit), path);
}

void write_atomically(const std::string& path, std::string_view bytes) { StagedFile(path, bytes).commit(); }

void write_together(std::span<const NamedText> files) {
  std::vector<StagedFile> staged;
  staged.reserve(files.size());
  for (const NamedText& file : files) staged.emplace_back(file.path, file.text);
  for (StagedFile& file : staged) file.commit();
}

void check_can_write(const std::string& path) {
  const std::filesystem::path target = target_of(path);
  if (::access(folder_of(target).c_str(), W_OK | X_OK) != 0)
    refuse(path, std::string("cannot write into the folder: ") + std::strerror(errno),
           "check its permissions");
}

void check_input_survives(const std::string& output, const std::string& input, const std::string& cure) {
  std::error_code code;
  if (!std::filesystem::equivalent(output, input, code)) return;
  throw Error(ErrorKind::kUsage, "this would replace the input file '" + input + "'", {output, 0, 0, ""},
              cure);
}

}  // namespace fuai
