// Speed, threads, kernels, limits and accuracy of the cloth engine: bench_engine [--markdown FILE] [--quick]
// [--only speed|threads|kernels|accuracy].
// SPDX-License-Identifier: Apache-2.0
#include "bench_engine.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>
#include <thread>

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

/// Mean number of runnable threads over the last minute; negative when the system does not say.
double load_average() {
  double load = -1.0;
  return getloadavg(&load, 1) == 1 ? load : -1.0;
}

/// Whether the times are worth more than their medians.
void report_load(Report& report, double before, double after) {
  if (before < 0.0 || after < 0.0) return;
  const unsigned cores = std::thread::hardware_concurrency();
  report.heading("Load of the machine");
  report.paragraph("Mean over a minute: " + fixed_text(before, 1) + " at the start, " + fixed_text(after, 1) +
                   " at the end, 1 of it this program, on " + std::to_string(cores) + " cores. " +
                   (std::max(before, after) > 1.5
                        ? "The machine was shared: times are medians with their spread, and ratios that hang "
                          "on caches and memory are not settled by this run."
                        : "Nothing else ran beside it."));
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
  const double load_before = load_average();
  const MachineLimits limits = measure_machine(quick ? 40 : 200);
  report_machine(report, limits);
  if (only.empty() || only == "speed") report_speed(report, quick);
  if (only.empty() || only == "threads") report_threads(report, quick);
  if (only.empty() || only == "kernels") report_kernels(report, limits, quick);
  if (only.empty() || only == "accuracy") report_accuracy(report, quick);
  report_load(report, load_before, load_average());
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
