// Measures the arithmetic and memory limits with the vectors the solver uses.
// SPDX-License-Identifier: Apache-2.0
#include "machine_limits.h"

#include <algorithm>

#include "thread_clock.h"

// As in implicit_kernels.cpp, so that the limits belong to the same instruction set.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "machine_limits.cpp"
#include "hwy/aligned_allocator.h"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace fuai_bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::ScalableTag<float>;

/// Floating-point operations of one pass of multiply_add(): twelve chains hide the latency of two units.
double multiply_add(long rounds, float* sink) {
  const Tag d;
  const auto a = hn::Set(d, 0.999F), b = hn::Set(d, 0.001F);
  auto v0 = hn::Iota(d, 0.F), v1 = hn::Iota(d, 1.F), v2 = hn::Iota(d, 2.F), v3 = hn::Iota(d, 3.F);
  auto v4 = hn::Iota(d, 4.F), v5 = hn::Iota(d, 5.F), v6 = hn::Iota(d, 6.F), v7 = hn::Iota(d, 7.F);
  auto v8 = hn::Iota(d, 8.F), v9 = hn::Iota(d, 9.F), v10 = hn::Iota(d, 10.F), v11 = hn::Iota(d, 11.F);
  for (long i = 0; i < rounds; ++i) {
    v0 = hn::MulAdd(v0, a, b);
    v1 = hn::MulAdd(v1, a, b);
    v2 = hn::MulAdd(v2, a, b);
    v3 = hn::MulAdd(v3, a, b);
    v4 = hn::MulAdd(v4, a, b);
    v5 = hn::MulAdd(v5, a, b);
    v6 = hn::MulAdd(v6, a, b);
    v7 = hn::MulAdd(v7, a, b);
    v8 = hn::MulAdd(v8, a, b);
    v9 = hn::MulAdd(v9, a, b);
    v10 = hn::MulAdd(v10, a, b);
    v11 = hn::MulAdd(v11, a, b);
  }
  const auto left =
      hn::Add(hn::Add(hn::Add(v0, v1), hn::Add(v2, v3)), hn::Add(hn::Add(v4, v5), hn::Add(v6, v7)));
  const auto sum = hn::Add(left, hn::Add(hn::Add(v8, v9), hn::Add(v10, v11)));
  *sink = hn::GetLane(hn::SumOfLanes(d, sum));
  return 2.0 * 12.0 * static_cast<double>(hn::Lanes(d)) * static_cast<double>(rounds);
}

/// y = a y + b over `count` numbers, a multiple of four vectors.
void sweep(float* y, std::size_t count) {
  const Tag d;
  const auto a = hn::Set(d, 0.999F), b = hn::Set(d, 0.001F);
  const std::size_t lanes = hn::Lanes(d);
  for (std::size_t i = 0; i < count; i += 4 * lanes) {
    const auto y0 = hn::Load(d, y + i), y1 = hn::Load(d, y + i + lanes);
    const auto y2 = hn::Load(d, y + i + 2 * lanes), y3 = hn::Load(d, y + i + 3 * lanes);
    hn::Store(hn::MulAdd(y0, a, b), d, y + i);
    hn::Store(hn::MulAdd(y1, a, b), d, y + i + lanes);
    hn::Store(hn::MulAdd(y2, a, b), d, y + i + 2 * lanes);
    hn::Store(hn::MulAdd(y3, a, b), d, y + i + 3 * lanes);
  }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace fuai_bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fuai_bench {

HWY_EXPORT(multiply_add);
HWY_EXPORT(sweep);
HWY_EXPORT(target_name);

namespace {

constexpr long kRounds = 500'000;
constexpr std::size_t kSweptBytes = std::size_t(64) << 20;
constexpr std::size_t kSizes[] = {std::size_t(16) << 10, std::size_t(512) << 10, std::size_t(8) << 20};

double measure_flops(int repetitions) {
  volatile float keep = 0.F;
  double best = 0.0;
  for (int i = 0; i < repetitions; ++i) {
    float sink = 0.F;
    const double start = thread_seconds();
    const double flops = HWY_DYNAMIC_DISPATCH(multiply_add)(kRounds, &sink);
    best = std::max(best, flops / (thread_seconds() - start));
    keep = keep + sink;
  }
  return best;
}

Bandwidth measure_bandwidth(std::size_t bytes, int repetitions) {
  const std::size_t count = bytes / sizeof(float), passes = kSweptBytes / bytes;
  const auto y = hwy::AllocateAligned<float>(count);
  std::fill_n(y.get(), count, 1.F);
  double best = 0.0;
  for (int i = 0; i < repetitions; ++i) {
    const double start = thread_seconds();
    for (std::size_t pass = 0; pass < passes; ++pass) HWY_DYNAMIC_DISPATCH(sweep)(y.get(), count);
    best = std::max(best, 2.0 * static_cast<double>(bytes * passes) / (thread_seconds() - start));
  }
  return {bytes, best};
}

}  // namespace

MachineLimits measure_machine(int repetitions) {
  MachineLimits limits;
  limits.target = HWY_DYNAMIC_DISPATCH(target_name)();
  limits.flops_per_second = measure_flops(repetitions);
  for (std::size_t bytes : kSizes) limits.bandwidths.push_back(measure_bandwidth(bytes, repetitions));
  return limits;
}

}  // namespace fuai_bench
#endif  // HWY_ONCE
