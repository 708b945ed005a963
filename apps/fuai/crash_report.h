// What is told when the program breaks down.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai_app {

/// From here on a signal that ends the program for a defect (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) first
/// writes where the program was to stderr; it still ends with that signal. Sanitizers tell more, and are left
/// to it.
/// @param version of the program, that lives as long as it. Thread class: set-up, once.
void report_crashes(const char* version);

}  // namespace fuai_app
