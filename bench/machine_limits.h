// What one core of this machine can do at most: arithmetic in the widest vectors, and memory traffic.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace fuai_bench {

/// Read and write rate of y = a y + b over an array.
struct Bandwidth {
  std::size_t bytes = 0;          ///< size of the array
  double bytes_per_second = 0.0;  ///< read plus written
};

/// Best of the repetitions, so that a busy neighbour does not lower the limit.
struct MachineLimits {
  double flops_per_second = 0.0;  ///< float, a fused multiply-add counts two
  std::vector<Bandwidth> bandwidths;
  const char* target = "";  ///< instruction set
};

/// Measures on the calling thread. @param repetitions > 0, each some milliseconds. Thread class: set-up.
MachineLimits measure_machine(int repetitions);

}  // namespace fuai_bench
