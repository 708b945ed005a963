// How a command names itself, its options and its examples. Only command_line.cpp knows the parser.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "console.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace fuai_app {

constexpr int kExitCheckFailed = 1, kExitUsage = 2, kExitBadInput = 3, kExitNoDevice = 4;

/// Runs a command that has been read. @return exit code
using CommandBody = std::function<int(const Console&)>;

/// An option, or with a name that does not begin with a dash a word at its place.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option& required();
  Option& among(std::initializer_list<const char*> words);
  Option& among(std::initializer_list<int> numbers);
  Option& range(int least, int most);
  /// The value is the name of a file or folder that the command writes.
  Option& file();

 private:
  CLI::Option* option_;
};

/// A command under construction. The values of its options must live as long as its body: they belong in what
/// the body captures. Copies mean the same command.
class Command {
 public:
  Command(CLI::App* app, CommandBody* chosen) : app_(app), chosen_(chosen) {}

  /// @param about one line of help. @return the new command
  Command command(const std::string& name, const std::string& about) const;
  /// The same for a name that only groups commands.
  Command group(const std::string& name, const std::string& about) const;

  /// A part of this command, under a heading of the help, of whose options exactly one must be given.
  Command one_of(const std::string& heading) const;

  /// Options of one word, of several and of a number. What `value` holds is the default, which the help shows
  /// unless it is empty or 0.
  Option option(const std::string& names, std::string& value, const std::string& help) const;
  Option option(const std::string& names, std::vector<std::string>& value, const std::string& help) const;
  Option option(const std::string& names, int& value, const std::string& help) const;
  void flag(const std::string& names, bool& value, const std::string& help) const;

  /// The command lines below the help.
  void examples(const std::vector<std::string>& lines) const;
  /// What the command does.
  void body(const CommandBody& run) const;

 private:
  CLI::App* app_;
  CommandBody* chosen_;
};

/// Adds the commands to the top of a command line.
using DeclareCommands = std::function<void(const Command&)>;

/// What a command takes: its words in their order ("FABRIC"), and its options with what they are.
struct CommandShape {
  enum class Kind { kText, kInteger, kFlag, kFile };
  struct Named {
    std::string name;  ///< without dashes
    Kind kind = Kind::kText;
  };
  std::vector<std::string> words;
  std::vector<Named> options;
};

/// Knows command lines without running them: for commands that write command lines.
class CommandChecker {
 public:
  explicit CommandChecker(const DeclareCommands& declare);
  ~CommandChecker();
  CommandChecker(const CommandChecker&) = delete;
  CommandChecker& operator=(const CommandChecker&) = delete;

  /// @param command one that exists
  CommandShape shape_of(const std::string& command) const;
  /// What the parser says about words after the program's name; empty when it takes them.
  std::string problem_of(const std::vector<std::string>& words);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// The version of the program, "0.1.0".
std::string program_version();

/// Reads the command line, the environment and --config, and runs what they name.
/// @param declare adds the commands
/// @return exit code. @throws Error of the command
int run_command_line(int argc, char** argv, const DeclareCommands& declare);

}  // namespace fuai_app
