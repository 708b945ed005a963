// Runs command lines as processes of their own, several at a time.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/runtime/processes.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cstring>
#include <memory>
#include <utility>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr int kWaitMilliseconds = 200;  ///< longest time between two calls of on_wait

[[noreturn]] void fail(const std::string& what, int code) {
  throw Error(ErrorKind::kCheckFailed, what + ": " + std::strerror(code), {},
              "run fewer processes at a time");
}

/// A file descriptor that is closed at the end of its scope.
class Handle {
 public:
  Handle() = default;
  explicit Handle(int number) : number_(number) {}
  Handle(Handle&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { close(); }

  int number() const noexcept { return number_; }
  bool open() const noexcept { return number_ >= 0; }
  void close() noexcept {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_ = -1;
};

/// The end that we read and the end that the process writes; neither goes to other processes.
std::pair<Handle, Handle> make_pipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail("cannot make a pipe", errno);
  return {Handle(ends[0]), Handle(ends[1])};
}

/// A process that was started; killed when it is forgotten.
class Child {
 public:
  Child(const ProcessWords& words, std::size_t index) {
    end_.index = index;
    auto [output, output_end] = make_pipe();
    auto [messages, messages_end] = make_pipe();
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, output_end.number(), STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, messages_end.number(), STDERR_FILENO);
    ProcessWords own = words;  // the system takes words that it may change
    std::vector<char*> pointers;
    for (std::string& word : own) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    const int code = ::posix_spawn(&pid_, own.front().c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (code != 0) {
      pid_ = -1;
      fail("cannot start '" + words.front() + "'", code);
    }
    streams_[0] = {std::move(output), &end_.output, kMostProcessOutput};
    streams_[1] = {std::move(messages), &end_.messages, kMostProcessMessages};
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (pid_ < 0) return;
    ::kill(pid_, SIGKILL);
    reap(0);
  }

  void add_to(std::vector<pollfd>& watched) const {
    for (const Stream& stream : streams_)
      if (stream.handle.open()) watched.push_back({stream.handle.number(), POLLIN, 0});
  }

  /// Takes what the descriptors have for us; called when at least one has something.
  void read(std::span<const pollfd> watched) {
    for (Stream& stream : streams_) {
      for (const pollfd& one : watched) {
        if (stream.handle.open() && one.fd == stream.handle.number() && one.revents != 0) stream.read();
      }
    }
  }

  bool silent() const { return !streams_[0].handle.open() && !streams_[1].handle.open(); }

  /// Whether it has ended; only asked once it is silent, as a process that runs on without its streams may.
  bool ended() { return silent() && reap(WNOHANG); }

  ProcessEnd take_end() { return std::move(end_); }

 private:
  struct Stream {
    Handle handle;
    std::string* text = nullptr;
    std::size_t most = 0;

    void read() {
      std::array<char, 65536> buffer;
      const ssize_t count = ::read(handle.number(), buffer.data(), buffer.size());
      if (count < 0 && errno == EINTR) return;
      if (count <= 0) {
        handle.close();
        return;
      }
      text->append(buffer.data(), std::min(static_cast<std::size_t>(count), most - text->size()));
    }
  };

  bool reap(int options) {
    int status = 0;
    pid_t got = 0;
    do {
      got = ::waitpid(pid_, &status, options);
    } while (got < 0 && errno == EINTR);
    if (got == 0) return false;
    pid_ = -1;
    if (got > 0 && WIFEXITED(status)) end_.exit_code = WEXITSTATUS(status);
    if (got > 0 && WIFSIGNALED(status)) end_.signal = WTERMSIG(status);
    end_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    return true;
  }

  ProcessEnd end_;
  pid_t pid_ = -1;
  std::array<Stream, 2> streams_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// Waits until a process says something, at most kWaitMilliseconds.
void wait_and_read(std::span<const std::unique_ptr<Child>> running) {
  constexpr int kLookAgainMilliseconds = 2;  // a process closes its streams just before it ends
  std::vector<pollfd> watched;
  bool ending = false;
  for (const auto& child : running) {
    child->add_to(watched);
    ending = ending || child->silent();
  }
  const int got = ::poll(watched.data(), watched.size(), ending ? kLookAgainMilliseconds : kWaitMilliseconds);
  if (got < 0 && errno != EINTR) fail("cannot wait for a process", errno);
  if (got <= 0) return;
  for (const auto& child : running) child->read(watched);
}

}  // namespace

void run_processes(std::span<const ProcessWords> commands, int at_once,
                   const std::function<void(ProcessEnd&&)>& on_end, const std::function<void()>& on_wait) {
  if (at_once < 1) throw Error(ErrorKind::kUsage, "at least one process must run at a time");
  std::vector<std::unique_ptr<Child>> running;
  std::size_t next = 0;
  while (next < commands.size() || !running.empty()) {
    while (next < commands.size() && running.size() < static_cast<std::size_t>(at_once)) {
      running.push_back(std::make_unique<Child>(commands[next], next));
      ++next;
    }
    wait_and_read(running);
    for (std::size_t i = 0; i < running.size();) {
      if (!running[i]->ended()) {
        ++i;
        continue;
      }
      const std::unique_ptr<Child> child = std::move(running[i]);
      running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      on_end(child->take_end());
    }
    if (on_wait) on_wait();
  }
}

std::string own_program() {
  std::array<char, PATH_MAX> path;
  const ssize_t size = ::readlink("/proc/self/exe", path.data(), path.size());
  if (size <= 0 || static_cast<std::size_t>(size) >= path.size())
    throw Error(ErrorKind::kCheckFailed, "the system does not say where the running program lies");
  return {path.data(), static_cast<std::size_t>(size)};
}

}  // namespace fuai
