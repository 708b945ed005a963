// A vendor's library, loaded at run time: which names were tried, what the loader said, what is missing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fuai/device/registry.h"

namespace fuai {

/// Once loaded it stays for the life of the process: its own threads may outlive the last device.
class VendorLibrary {
 public:
  /// Tries the names in their order; only the path in the environment's `variable` where that is set.
  /// Never throws for what it finds. Thread class: set-up.
  VendorLibrary(const char* variable, std::span<const char* const> names);

  bool loaded() const { return handle_ != nullptr; }
  /// One finding a name tried, with the loader's own words. Thread class: any.
  const std::vector<DriverFinding>& findings() const { return findings_; }
  /// What another library needs and nobody has: "libncurses.so.5"; empty when there is no such thing.
  /// Thread class: any.
  const std::string& missing_dependency() const { return missing_dependency_; }
  /// Functions asked for with find() and not there, by commas. Thread class: any.
  const std::string& missing_functions() const { return missing_functions_; }

  /// Why it cannot be used, after all find(): not found, a dependency or functions missing; empty when it
  /// can. Thread class: any.
  std::string problem() const;

  /// Sets `function` to the library's `name`. @return whether it has it; if not, nullptr, and the name is
  /// kept in missing_functions(). Thread class: set-up.
  template <class F>
  bool find(const char* name, F*& function) {
    function = reinterpret_cast<F*>(address(name));
    if (function == nullptr)
      missing_functions_ += (missing_functions_.empty() ? "" : ", ") + std::string(name);
    return function != nullptr;
  }
  /// The same for what may be missing. Thread class: set-up.
  template <class F>
  bool find_optional(const char* name, F*& function) const {
    function = reinterpret_cast<F*>(address(name));
    return function != nullptr;
  }

 private:
  void* address(const char* name) const;

  void* handle_ = nullptr;
  std::vector<DriverFinding> findings_;
  std::string missing_dependency_, missing_functions_;
};

}  // namespace fuai
