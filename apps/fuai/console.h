// What the program says: results on standard output, messages and progress on standard error.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "fuai/core/progress.h"
#include "json_value.h"

namespace fuai_app {

/// Options that every command has.
struct CommonOptions {
  bool json = false;
  int verbosity = 0;  ///< -1 quiet, 0 normal, 1 verbose
  unsigned seed = 0;
  int threads = 0;  ///< 0: as many as the machine has
};

/// Where a command speaks.
class Console {
 public:
  explicit Console(CommonOptions options) : options_(options) {}

  const CommonOptions& options() const { return options_; }
  /// A line of the result for people; nothing with --json.
  void line(std::string_view text) const;
  /// A message on standard error; silent with -q.
  void say(std::string_view text) const;
  /// A message on standard error only with -v.
  void detail(std::string_view text) const;
  /// A warning on standard error, also with -q.
  void warn(std::string_view text) const;
  /// The one JSON object of --json; nothing otherwise.
  void result(const JsonValue& value) const;
  /// A progress bar on standard error when that is a terminal and -q is absent; it shows after one second.
  fuai::Progress progress() const;

 private:
  CommonOptions options_;
};

/// "0.067", four significant digits, no exponent in the everyday range.
std::string format_number(double value);

}  // namespace fuai_app
