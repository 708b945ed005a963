// Makes the law of one measured curve.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/curve_law.h"

#include <algorithm>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/fabric/branch_nodes.h"
#include "fuai/fabric/cycle_comparison.h"
#include "fuai/fabric/scalar_laws.h"

namespace fuai {
namespace {

/// Of the replayed law from the samples.
double replay_residual(const PlayLaw& law, const MeasuredCurve& curve) {
  return rms_over_peak(compare_cycles(law, curve).predicted, curve);
}

CurveLaw law_of_loop(const MeasuredCurve& curve, double jamming_curvature) {
  CurveLaw result;
  const LoopNodes nodes = loop_nodes(curve, kLoopNodes, result.notes);
  const std::vector<PlayElement> elements = smoothest_elements(nodes);
  const double range = std::max(nodes.high, -nodes.low);
  const Extrapolation outside =
      curve.test == Test::kBending ? bending_outside(range, jamming_curvature) : shear_outside();
  result.law = identify_loop(nodes, elements, outside);
  result.largest_radius = elements.back().radius;
  result.notes.emplace_back(
      "play radii chosen so that the friction strength varies least: the loop does not show them");
  return result;
}

CurveLaw law_of_virgin_curve(const MeasuredCurve& curve, double jamming_curvature) {
  CurveLaw best;
  std::vector<std::string> notes;
  const VirginNodes nodes = virgin_nodes(curve, kVirginNodes, notes);
  Extrapolation outside = shear_outside();
  if (curve.test == Test::kBending) outside = bending_outside(nodes.high, jamming_curvature);
  if (curve.test == Test::kTensile) {
    // The last tenth of the loading branch says how it goes on.
    const std::size_t back = kVirginNodes / 10;
    const double span = nodes.high * static_cast<double>(back) / static_cast<double>(kVirginNodes - 1);
    outside = tensile_outside(nodes.load.back() / nodes.high,
                              (nodes.load.back() - nodes.load[kVirginNodes - 1 - back]) / span);
  }
  const bool mirrored = curve.test != Test::kTensile;
  best.rms_residual = INFINITY;
  for (double radius = nodes.high; radius > 0.02 * nodes.high; radius /= 1.15) {
    CurveLaw candidate;
    candidate.law = identify_virgin(nodes, scaled_elements(radius), mirrored, outside);
    candidate.rms_residual = replay_residual(candidate.law, curve);
    candidate.largest_radius = radius;
    if (candidate.rms_residual < best.rms_residual) best = std::move(candidate);
  }
  best.notes = std::move(notes);
  if (mirrored)
    best.notes.emplace_back("only one side was measured; the other is assumed to be its mirror image");
  best.notes.emplace_back("play radii chosen so that the law repeats all measured cycles best");
  return best;
}

}  // namespace

CurveLaw make_curve_law(const MeasuredCurve& curve, double jamming_curvature) {
  if (curve.test == Test::kCompression) {
    throw Error(ErrorKind::kBadInput, "a compression curve has no play law", {curve.source, 0, 0, ""});
  }
  CurveLaw result = curve.test != Test::kTensile && is_two_sided(curve)
                        ? law_of_loop(curve, jamming_curvature)
                        : law_of_virgin_curve(curve, jamming_curvature);
  result.rms_residual = replay_residual(result.law, curve);
  return result;
}

}  // namespace fuai
