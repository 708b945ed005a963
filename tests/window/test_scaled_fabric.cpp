// What is saved after the sliders were moved behaves as it did in the window.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include "fuai/io/fabric_library.h"
#include "fuai/window/scaled_fabric.h"

namespace {

using namespace fuai;

ViewFabric loaded(const char* name) {
  ViewFabric fabric;
  fabric.source = name;
  fabric.measured = load_fabric(name);
  return fabric;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("Without a change the fabric is the measured one") {
    const ViewFabric fabric = loaded("cupro-woven-su1098");
    const Fabric same = scaled_fabric(fabric);
    CHECK(same.name == fabric.measured.name);
    CHECK(same.bending[0].B.value == fabric.measured.bending[0].B.value);
    CHECK(same.tensile[0].curve.has_value() == fabric.measured.tensile[0].curve.has_value());
  }

  TEST_CASE("A fabric known by numbers keeps its law: B and 2HB times their factors") {
    ViewFabric fabric = loaded("wool-tropical");
    fabric.factors[static_cast<std::size_t>(FabricFactor::kWarpBending)] = 2.0;
    fabric.factors[static_cast<std::size_t>(FabricFactor::kBendingFriction)] = 0.5;
    fabric.factors[static_cast<std::size_t>(FabricFactor::kWeight)] = 1.5;
    const Fabric scaled = scaled_fabric(fabric);
    const Fabric& measured = fabric.measured;
    // The numbers are read off the law by the instrument's rule: 1 % as in the round trip.
    CHECK(scaled.bending[0].B.value == doctest::Approx(2.0 * measured.bending[0].B.value).epsilon(0.01));
    CHECK(scaled.bending[0].hysteresis_2HB.value ==
          doctest::Approx(0.5 * measured.bending[0].hysteresis_2HB.value).epsilon(0.01));
    CHECK(scaled.bending[1].B.value == doctest::Approx(measured.bending[1].B.value).epsilon(0.01));
    CHECK(scaled.areal_mass.value == doctest::Approx(1.5 * measured.areal_mass.value));
    CHECK(scaled.bending[0].B.provenance.kind == ProvenanceKind::kAssumed);
    CHECK(scaled.areal_mass.provenance.kind == ProvenanceKind::kAssumed);
    CHECK(scaled.thickness.value == measured.thickness.value);
  }
}
