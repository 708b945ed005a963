// Standard output, standard error and the progress bar.
// SPDX-License-Identifier: Apache-2.0
#include "console.h"

#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace fuai_app {
namespace {

using Clock = std::chrono::steady_clock;

/// Draws "[####....]  42 %  what" over itself; wiped when done.
class ProgressBar {
 public:
  ~ProgressBar() { wipe(); }

  void show(std::string_view what, double fraction) {
    const Clock::time_point now = Clock::now();
    if (now - begin_ < std::chrono::seconds(1) || now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(std::lround(kWidth * std::min(std::max(fraction, 0.0), 1.0)));
    const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                            std::string(static_cast<std::size_t>(kWidth - filled), '.');
    const char* bold = colour_ ? "\x1b[1m" : "";
    const char* plain = colour_ ? "\x1b[0m" : "";
    std::fprintf(stderr, "\r\x1b[K[%s%s%s] %3.0f %%  %.*s", bold, bar.c_str(), plain, 100.0 * fraction,
                 static_cast<int>(what.size()), what.data());
    std::fflush(stderr);
    drawn_ = true;
  }

 private:
  void wipe() const {
    if (drawn_) std::fputs("\r\x1b[K", stderr);
  }

  Clock::time_point begin_ = Clock::now(), last_;
  bool drawn_ = false;
  bool colour_ = std::getenv("NO_COLOR") == nullptr;
};

void print(std::FILE* stream, std::string_view text) {
  std::fprintf(stream, "%.*s\n", static_cast<int>(text.size()), text.data());
}

}  // namespace

void Console::line(std::string_view text) const {
  if (!options_.json) print(stdout, text);
}

void Console::say(std::string_view text) const {
  if (options_.verbosity >= 0) print(stderr, text);
}

void Console::detail(std::string_view text) const {
  if (options_.verbosity >= 1) print(stderr, text);
}

void Console::warn(std::string_view text) const { print(stderr, "warning: " + std::string(text)); }

void Console::result(const JsonValue& value) const {
  if (options_.json) print(stdout, value.dump());
}

fuai::Progress Console::progress() const {
  if (options_.verbosity < 0 || isatty(STDERR_FILENO) == 0) return {};
  return [bar = std::make_shared<ProgressBar>()](std::string_view what, double fraction) {
    bar->show(what, fraction);
  };
}

std::string format_number(double value) {
  char text[40];
  const double size = std::abs(value);
  if (size != 0.0 && (size < 1e-4 || size >= 1e6)) {
    std::snprintf(text, sizeof text, "%.3e", value);
  } else {
    std::snprintf(text, sizeof text, "%.4g", value);
  }
  return text;
}

}  // namespace fuai_app
