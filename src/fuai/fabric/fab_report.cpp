// Describes the fits of a Fabric Analyzer record.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/fab_report.h"

#include <cstdio>

#include "fuai/units/constants.h"

namespace fuai {
namespace {

std::string bending_line(const BucklingFit& fit) {
  char text[400];
  std::snprintf(text, sizeof text,
                "bending %s: B = %.4f ± %.4f gf·cm²/cm (D1 alone %.4f, U1 alone %.4f), 2HB = %.4f ± %.4f "
                "gf·cm/cm, clamps "
                "tilted %.1f deg; rms %.3f gf, %.1f %% of the span",
                to_string(fit.direction), fit.B / unit::kGfCm2PerCm, fit.B_error / unit::kGfCm2PerCm,
                fit.B_alone[0] / unit::kGfCm2PerCm, fit.B_alone[1] / unit::kGfCm2PerCm,
                fit.hysteresis_2HB / unit::kGfCmPerCm, fit.hysteresis_2HB_error / unit::kGfCmPerCm,
                fit.clamp_tilt / unit::kDegree, fit.rms / unit::kGramForce, 100.0 * fit.rms_fraction);
  return std::string(text) + "; " + fit.quality;
}

std::string test_line(const BucklingFit& fit, const BucklingTestFit& test) {
  char text[240];
  std::snprintf(text, sizeof text,
                "  %s %s: offset %.3f gf, drift %.3f gf, rms %.3f gf of a span of %.3f gf%s",
                to_string(fit.direction), to_string(test.test), test.offset / unit::kGramForce,
                test.drift / unit::kGramForce, test.rms / unit::kGramForce, test.span / unit::kGramForce,
                test.fitted ? "" : " (predicted, not fitted)");
  return text;
}

std::string stretch_line(const FabStretch& stretch) {
  char text[240];
  std::snprintf(
      text, sizeof text,
      "tensile %s: %zu branches to %.1f %% at %.1f gf/cm; noise %.2f gf/cm, takes up load at %.2f %%",
      to_string(stretch.curve.direction), stretch.curve.branches.size(), stretch.peak_strain / unit::kPercent,
      stretch.peak_load / unit::kGfPerCm, stretch.force_noise / unit::kGfPerCm,
      stretch.take_up_strain / unit::kPercent);
  return text;
}

std::string shear_line(const FabShear& shear) {
  char text[240];
  std::snprintf(text, sizeof text,
                "shear from the bias strip: to %.1f ± %.1f deg, largest lateral stretch %.3f",
                shear.largest_angle / unit::kDegree, shear.angle_uncertainty / unit::kDegree,
                shear.largest_lateral_stretch);
  return std::string(text) + "; " + shear.quality;
}

}  // namespace

std::vector<std::string> describe(const FabFitReport& report) {
  std::vector<std::string> lines;
  for (const BucklingFit& fit : report.bending) {
    lines.push_back(bending_line(fit));
    for (const BucklingTestFit& test : fit.tests) lines.push_back(test_line(fit, test));
  }
  for (const FabStretch& stretch : report.tensile) lines.push_back(stretch_line(stretch));
  if (report.shear) lines.push_back(shear_line(*report.shear));
  for (const std::string& assumption : report.assumptions) lines.push_back("assumed: " + assumption);
  return lines;
}

}  // namespace fuai
