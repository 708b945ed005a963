// Stretch under tension, and the rule for the tension of a test.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/shear_test.h"

namespace fuai {

MeasuredCurve to_shear_stress(MeasuredCurve forces, const ShearTest& test) {
  for (CurveBranch& branch : forces.branches) {
    for (CurveSample& s : branch.samples) s.stress = shear_stress(test, s.stress, s.strain);
  }
  return forces;
}

MeasuredCurve to_shear_force(MeasuredCurve stresses, const ShearTest& test) {
  for (CurveBranch& branch : stresses.branches) {
    for (CurveSample& s : branch.samples) s.stress = shear_force(test, s.stress, s.strain);
  }
  return stresses;
}

double stretch_under(const PlayLaw& tensile, double load) noexcept {
  const PlayState virgin;
  const auto carried = [&](double strain) { return tensile.evaluate(strain, virgin).stress; };
  // Bisection on the rising first loading, to the last bits.
  double low = 0.0, high = 1e-3;
  while (carried(high) < load && high < 10.0) high *= 2.0;
  for (int i = 0; i < 60 && load > 0.0; ++i) {
    const double middle = 0.5 * (low + high);
    (carried(middle) < load ? low : high) = middle;
  }
  return load > 0.0 ? 1.0 + 0.5 * (low + high) : 1.0;
}

ShearTest shear_test_of(const Fabric& fabric, std::span<const PlayLaw> tensile) noexcept {
  const ShearMeasurement& shear = fabric.shear;
  ShearTest test;
  const bool bias = shear.curve && shear.curve->curve.direction == Direction::kBias;
  test.tension = shear.tension.has_value() ? shear.tension.value : (bias ? 0.0 : kKesShearTension);
  double inverse = 0.0;
  for (const PlayLaw& law : tensile) inverse += 1.0 / stretch_under(law, test.tension);
  if (!tensile.empty()) test.stretch = static_cast<double>(tensile.size()) / inverse;
  return test;
}

}  // namespace fuai
