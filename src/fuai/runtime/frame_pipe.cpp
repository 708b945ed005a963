// Starts ffmpeg with a pipe for its standard input.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/frame_pipe.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "fuai/core/error.h"

namespace fuai {

bool FramePipe::available() {
  const char* path = std::getenv("PATH");
  const std::string folders = path != nullptr ? path : "";
  for (std::size_t start = 0; start <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', start), folders.size());
    const std::string program = folders.substr(start, end - start) + "/ffmpeg";
    if (access(program.c_str(), X_OK) == 0) return true;
    start = end + 1;
  }
  return false;
}

FramePipe::FramePipe(const std::string& path, int width, int height, int frames_a_second) {
  if (!available())
    throw Error(ErrorKind::kNoDevice, "there is no ffmpeg to make a video", {}, "install the package ffmpeg");
  const std::string size = std::to_string(width) + "x" + std::to_string(height),
                    rate = std::to_string(frames_a_second);
  std::vector<std::string> words = {"ffmpeg",   "-y",      "-loglevel", "error", "-f", "rawvideo", "-pix_fmt",
                                    "rgba",     "-s",      size,        "-r",    rate, "-i",       "-",
                                    "-pix_fmt", "yuv420p", "-crf",      "20",    path};
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0)
    throw Error(ErrorKind::kBadInput, std::string("no pipe to ffmpeg: ") + std::strerror(errno), {},
                "close some programs and try again");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  const int failed = posix_spawnp(&process_, "ffmpeg", &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[0]);
  if (failed != 0) {
    close(ends[1]);
    throw Error(ErrorKind::kBadInput, std::string("ffmpeg cannot be started: ") + std::strerror(failed), {},
                "see whether ffmpeg runs in a terminal");
  }
  pipe_ = ends[1];
}

FramePipe::~FramePipe() {
  if (pipe_ >= 0) close(pipe_);
  while (process_ > 0 && waitpid(process_, nullptr, 0) < 0 && errno == EINTR) continue;
}

bool FramePipe::write(std::span<const std::uint8_t> rgba) noexcept {
  // An ffmpeg that has ended would end this program by a signal.
  struct sigaction ignore {
  }, before{};
  ignore.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, &ignore, &before);
  std::size_t done = 0;
  bool fine = pipe_ >= 0;
  while (fine && done < rgba.size()) {
    const ssize_t count = ::write(pipe_, rgba.data() + done, rgba.size() - done);
    if (count > 0)
      done += static_cast<std::size_t>(count);
    else
      fine = count < 0 && errno == EINTR;
  }
  sigaction(SIGPIPE, &before, nullptr);
  return fine;
}

}  // namespace fuai
