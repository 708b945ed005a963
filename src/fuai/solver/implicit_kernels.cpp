// Compiles the vector kernels for each instruction set and chooses one at run time.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/solver/implicit_kernels.h"

// The widest sets only: SSSE3, SSE4 and the AVX-512 variants beyond the first bring nothing here and cost
// compile time. The baseline stays.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fuai/solver/implicit_kernels.cpp"
#include <hwy/foreach_target.h>  // IWYU pragma: keep

#include <hwy/highway.h>
#include "fuai/solver/implicit_lines-inl.h"
#include "fuai/solver/implicit_vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace fuai {
namespace HWY_NAMESPACE {

template <class T>
int scratch_numbers(const ImplicitGrid<T>& g) {
  return static_cast<int>(kWeftBeside * weft_scratch(g));
}

template <class T>
ImplicitKernels<T> make_kernels() {
  ImplicitKernels<T> k;
  k.evaluate = &evaluate_rows<T>;
  k.commit = &commit_rows<T>;
  k.multiply = &multiply_rows<T>;
  k.assemble = &assemble_vectors<T>;
  k.factor_warp = &factor_warp_half<T>;
  k.factor_meeting = &factor_meeting_vectors<T>;
  k.factor_weft = &factor_weft_vectors<T>;
  k.solve_warp_in = &solve_warp_in<T>;
  k.solve_warp_out = &solve_warp_out<T>;
  k.solve_weft = &solve_weft_vectors<T>;
  k.advance = &advance_rows<T>;
  k.direct = &direct_rows<T>;
  k.begin_solve = &begin_solve_rows<T>;
  k.keep = &keep_rows<T>;
  k.replace = &replace_rows<T>;
  k.scale_d = &scale_d_rows<T>;
  k.stop = &stop_rows<T>;
  k.move = &move_rows<T>;
  k.work_d = &work_d_rows<T>;
  k.work_v = &work_v_rows<T>;
  k.length_d = &length_d_rows<T>;
  k.square = &square_rows<T>;
  k.finish = &finish_rows<T>;
  k.scratch_size = &scratch_numbers<T>;
  k.target = hwy::TargetName(HWY_TARGET);
  k.lanes = static_cast<int>(hn::Lanes(Tag<T>()));
  return k;
}

ImplicitKernels<float> float_kernels() { return make_kernels<float>(); }
ImplicitKernels<double> double_kernels() { return make_kernels<double>(); }

}  // namespace HWY_NAMESPACE
}  // namespace fuai
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace fuai {

HWY_EXPORT(float_kernels);
HWY_EXPORT(double_kernels);

template <>
const ImplicitKernels<float>& implicit_kernels<float>() {
  static const ImplicitKernels<float> kernels = HWY_DYNAMIC_DISPATCH(float_kernels)();
  return kernels;
}
template <>
const ImplicitKernels<double>& implicit_kernels<double>() {
  static const ImplicitKernels<double> kernels = HWY_DYNAMIC_DISPATCH(double_kernels)();
  return kernels;
}

}  // namespace fuai
#endif  // HWY_ONCE
