// Loads a vendor's library.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/device/vendor_library.h"

#include <dlfcn.h>

#include <cstdlib>
#include <string_view>

namespace fuai {

VendorLibrary::VendorLibrary(const char* variable, std::span<const char* const> names) {
  const char* const chosen = std::getenv(variable);
  const bool is_chosen = chosen != nullptr && *chosen != '\0';
  const std::span<const char* const> tried = is_chosen ? std::span<const char* const>(&chosen, 1) : names;
  for (const char* name : tried) {
    const std::string what = is_chosen ? std::string(variable) + "=" + name : "library " + std::string(name);
    // NODELETE: vendors' threads may still run when the last device is closed.
    handle_ = ::dlopen(name, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle_ != nullptr) {
      findings_.push_back({what, "found", true});
      return;
    }
    const char* const told = ::dlerror();
    const std::string text = told != nullptr ? told : "the loader does not say why";
    findings_.push_back({what, text, false});
    // The loader begins with the file that it could not open: another one is a dependency.
    const std::string_view file = std::string_view(text).substr(0, text.find(':'));
    if (text.find("cannot open shared object file") != std::string::npos && file != name)
      missing_dependency_ = file;
  }
}

void* VendorLibrary::address(const char* name) const {
  return handle_ == nullptr ? nullptr : ::dlsym(handle_, name);
}

std::string VendorLibrary::problem() const {
  if (!missing_dependency_.empty() && !loaded())
    return "the vendor's library needs " + missing_dependency_ + ", which is missing";
  if (!loaded()) return "the vendor's library was not found: " + findings_.back().found;
  return missing_functions_.empty() ? "" : "the vendor's library has no " + missing_functions_;
}

}  // namespace fuai
