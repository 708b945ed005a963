// Runs independent tasks on a few threads.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <span>

namespace fuai {

/// Runs every task once, `threads` at a time, and returns when all are done. Tasks are started in their
/// order; they must not share data, so the results do not depend on the number of threads.
/// @param threads 0: as many as the machine has cores
/// @throws whatever the first failing task (in their order) threw, after all have ended. Thread class:
/// set-up.
void run_parallel(std::span<const std::function<void()>> tasks, int threads);

}  // namespace fuai
