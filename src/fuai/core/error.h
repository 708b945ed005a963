// The one exception type of fuai: what is wrong, where it stands, and how to mend it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace fuai {

/// What kind of mistake an Error reports; the command line maps it to its exit code.
enum class ErrorKind {
  kCheckFailed,  ///< a computation did not reach what it promised (exit code 1)
  kUsage,        ///< a wrong call or option (exit code 2)
  kBadInput,     ///< a file or value from outside is wrong (exit code 3)
  kNoDevice,     ///< no device, display or graphics driver (exit code 4)
};

/// A place in a file. Zero line or column, or an empty string, means "not known".
struct Where {
  std::string file;  ///< path as the user gave it
  int line = 0;      ///< 1-based
  int column = 0;    ///< 1-based
  std::string key;   ///< key or column name, e.g. "bending.warp.B_gf_cm2_per_cm"
};

/// Thrown at the edges (make_, prepare, fit, read_, write_, programs); never in real-time code. Thread class:
/// any.
class Error : public std::runtime_error {
 public:
  /// @param kind kind of mistake
  /// @param what what is wrong, a sentence without a full stop
  /// @param where where it stands
  /// @param cure how to mend it, a sentence without a full stop; may be empty
  Error(ErrorKind kind, const std::string& what, Where where = {}, std::string cure = {});

  ErrorKind kind() const { return kind_; }
  const Where& where() const { return where_; }
  const std::string& cure() const { return cure_; }
  /// The bare sentence without place and cure.
  const std::string& problem() const { return problem_; }

 private:
  ErrorKind kind_;
  std::string problem_;
  Where where_;
  std::string cure_;
};

/// "file:line:column: key: " with the unknown parts left out; empty when nothing is known.
std::string to_string(const Where& where);

}  // namespace fuai
