// Puts measured curves into a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/from_curves.h"

#include <cmath>
#include <string>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/fabric/kes_parameters.h"

namespace fuai {
namespace {

/// Sets a number that the curve shows; one that it does not show stays.
void set_computed(Known& known, double value, const Provenance& curve) {
  if (std::isnan(value)) return;
  known = {value,
           {ProvenanceKind::kComputed, "by definition from the curve: " + curve.source, curve.quality}};
}

void warn_missing(Fabric& fabric, const MeasuredCurve& curve, const std::vector<std::string>& missing) {
  for (const std::string& sentence : missing) {
    fabric.warnings.push_back(std::string(to_string(curve.test)) + " curve (" + to_string(curve.direction) +
                              "): " + sentence);
  }
}

}  // namespace

void add_measured_curve(Fabric& fabric, KnownCurve known) {
  const MeasuredCurve& curve = known.curve;
  const auto i = static_cast<std::size_t>(curve.direction);
  switch (curve.test) {
    case Test::kBending: {
      const BendingParameters p = compute_bending_parameters(curve);
      set_computed(fabric.bending[i].B, p.B.mean(), known.provenance);
      set_computed(fabric.bending[i].hysteresis_2HB, p.hysteresis_2HB.mean(), known.provenance);
      warn_missing(fabric, curve, p.missing);
      fabric.bending[i].curve = std::move(known);
      return;
    }
    case Test::kShear: {
      const ShearParameters p = compute_shear_parameters(curve);
      set_computed(fabric.shear.G, p.G.mean(), known.provenance);
      set_computed(fabric.shear.hysteresis_2HG, p.hysteresis_2HG.mean(), known.provenance);
      set_computed(fabric.shear.hysteresis_2HG5, p.hysteresis_2HG5.mean(), known.provenance);
      warn_missing(fabric, curve, p.missing);
      fabric.shear.curve = std::move(known);
      return;
    }
    case Test::kTensile: {
      if (i >= fabric.tensile.size()) {
        throw Error(ErrorKind::kBadInput, "a tensile curve in bias direction has no place in a fabric",
                    {curve.source, 0, 0, ""},
                    "import it as direction warp or weft, or turn it into a shear curve");
      }
      TensileMeasurement& t = fabric.tensile[i];
      const TensileParameters p = compute_tensile_parameters(curve);
      set_computed(t.LT, p.LT, known.provenance);
      set_computed(t.WT, p.WT, known.provenance);
      set_computed(t.RT, p.RT, known.provenance);
      set_computed(t.EMT, p.EMT, known.provenance);
      set_computed(t.peak_load, p.peak_load, known.provenance);
      warn_missing(fabric, curve, p.missing);
      t.curve = std::move(known);
      return;
    }
    case Test::kCompression: {
      const CompressionParameters p = compute_compression_parameters(curve, fabric.thickness.value);
      set_computed(fabric.compression.LC, p.LC, known.provenance);
      set_computed(fabric.compression.WC, p.WC, known.provenance);
      set_computed(fabric.compression.RC, p.RC, known.provenance);
      warn_missing(fabric, curve, p.missing);
      fabric.compression.curve = std::move(known);
      return;
    }
  }
}

}  // namespace fuai
