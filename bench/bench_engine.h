// The parts of the engine's bench; each measures and adds its tables to the report.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bench_report.h"
#include "machine_limits.h"

namespace fuai_bench {

/// Time of one tick on one core of our solvers and Bullet's, in turns.
void report_speed(Report& report, bool quick);
/// Time of one tick on two threads beside one.
void report_threads(Report& report, bool quick);
/// Time of each kernel of a tick, and how near to the machine's limits it comes.
void report_kernels(Report& report, const MachineLimits& limits, bool quick);
/// Force error and time on the taut patch.
void report_accuracy(Report& report, bool quick);

}  // namespace fuai_bench
