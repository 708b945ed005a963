// Runs command lines as processes of their own, several at a time.
// SPDX-License-Identifier: Apache-2.0
//
//   this thread   starts processes until `at_once` run, gathers what they say through pipes, and hands over
//                 each one that has ended before it starts the next
//
// When the caller throws, the running processes are killed. When this program itself is killed they go on to
// their end, but nobody gathers what they say.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace fuai {

/// The program and its words.
using ProcessWords = std::vector<std::string>;

/// What a process left behind.
struct ProcessEnd {
  std::size_t index = 0;  ///< of its command line
  int exit_code = -1;     ///< -1 when a signal ended it
  int signal = 0;         ///< 0 when it ended by itself
  std::string output;     ///< standard output, at most kMostProcessOutput bytes; the rest is dropped
  std::string messages;   ///< standard error, at most kMostProcessMessages bytes; the rest is dropped
  double seconds = 0.0;   ///< wall clock
};

inline constexpr std::size_t kMostProcessOutput = 64ULL * 1024 * 1024;
inline constexpr std::size_t kMostProcessMessages = 64ULL * 1024;

/// Starts the command lines in their order and returns when all have ended. Standard input is empty.
/// @param commands the first word of each is the path of a program
/// @param at_once processes that run at a time, at least 1
/// @param on_end called on this thread with each that ended, in the order of ending
/// @param on_wait called on this thread about five times a second; may be empty
/// @throws Error (kCheckFailed) when a process cannot be started, (kUsage) for a wrong `at_once`; whatever
/// the callbacks throw. Thread class: set-up.
void run_processes(std::span<const ProcessWords> commands, int at_once,
                   const std::function<void(ProcessEnd&&)>& on_end,
                   const std::function<void()>& on_wait = {});

/// Path of the running program. @throws Error (kCheckFailed) when the system does not say. Thread class:
/// set-up.
std::string own_program();

}  // namespace fuai
