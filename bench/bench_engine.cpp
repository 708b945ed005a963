// Speed, threads, kernels, limits and accuracy of the cloth engine: bench_engine [--markdown FILE] [--quick]
// [--only speed|threads|kernels|accuracy].
// SPDX-License-Identifier: Apache-2.0
#include "bench_engine.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "fuai/solver/implicit_kernels.h"
#ifdef FUAI_BENCH_BULLET
#include "bullet_cloth.h"
#endif

namespace {

using namespace fuai_bench;

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

/// With this load or less the program was alone: its own one thread, two for a part of a minute.
constexpr double kAlone = 1.7;

/// Mean number of runnable threads over the last minute; negative when the system does not say.
double load_average() {
  double load = -1.0;
  return getloadavg(&load, 1) == 1 ? load : -1.0;
}

/// Whether the times are worth more than their medians. @param loads between the parts of the bench
void report_load(Report& report, const std::vector<double>& loads) {
  const auto [least, most] = std::ranges::minmax(loads);
  if (least < 0.0) return;
  report.heading("Load of the machine");
  report.paragraph("Mean over a minute, before, between and after the parts: " + fixed_text(least, 1) +
                   " to " + fixed_text(most, 1) +
                   ", 1 of it this program and 2 while it times two threads, on " +
                   std::to_string(std::thread::hardware_concurrency()) + " cores. " +
                   (most > kAlone ? "The machine was shared: times are medians with their spread, and ratios "
                                    "that hang on caches and memory are not settled by this run."
                                  : "Nothing else was seen beside it."));
}

void report_machine(Report& report, const MachineLimits& limits) {
  const auto& kernels = fuai::implicit_kernels<float>();
  report.heading("Machine");
  std::string text = processor_name() + "; the solver uses " + kernels.target + ", " +
                     std::to_string(kernels.lanes) + " floats a vector.";
#ifdef FUAI_BENCH_BULLET
  text += " Bullet " + fixed_text(0.01 * BulletCloth::version(), 2) + ".";
#endif
  report.paragraph(text);
  std::vector<Row> rows{
      {"multiply-add of floats", fixed_text(1e-9 * limits.flops_per_second, 0) + " Gflop/s"}};
  for (const Bandwidth& b : limits.bandwidths)
    rows.push_back({"read and write within " + std::to_string(b.bytes / 1024) + " KiB",
                    fixed_text(1e-9 * b.bytes_per_second, 0) + " GB/s"});
  report.table({"limit of one core (" + std::string(limits.target) + ")", "best measured"}, rows);
}

int run(int count, char** arguments) {
  bool quick = false;
  std::string file, only;
  for (int i = 1; i < count; ++i) {
    const std::string argument = arguments[i];
    if (argument == "--quick") {
      quick = true;
    } else if (argument == "--markdown" && i + 1 < count) {
      file = arguments[++i];
    } else if (argument == "--only" && i + 1 < count) {
      only = arguments[++i];
    } else {
      std::fprintf(
          stderr,
          "usage: bench_engine [--markdown FILE] [--quick] [--only speed|threads|kernels|accuracy]\n");
      return 2;
    }
  }
  Report report;
  std::vector<double> loads{load_average()};
  const MachineLimits limits = measure_machine(quick ? 40 : 200);
  report_machine(report, limits);
  const auto part = [&](const char* name, const std::function<void()>& measure) {
    if (!only.empty() && only != name) return;
    measure();
    loads.push_back(load_average());
  };
  part("speed", [&] { report_speed(report, quick); });
  part("threads", [&] { report_threads(report, quick); });
  part("kernels", [&] { report_kernels(report, limits, quick); });
  part("accuracy", [&] { report_accuracy(report, quick); });
  report_load(report, loads);
  if (file.empty()) return 0;
  std::ofstream out(file);
  out << "# Measured figures of the cloth engine\n\nWritten by `bench_engine --markdown`"
      << (quick ? " (`--quick`)" : "") << "; do not edit.\n\n"
      << report.markdown();
  if (!out.flush()) {
    std::fprintf(stderr, "bench_engine: cannot write %s\n", file.c_str());
    return 1;
  }
  return 0;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    return run(count, arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_engine: %s\n", error.what());
    return 1;
  }
}
