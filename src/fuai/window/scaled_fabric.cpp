// Reads the numbers of changed blocks off their laws.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/scaled_fabric.h"

#include <algorithm>
#include <cstdio>
#include <limits>

#include "fuai/io/fabric_fields.h"
#include "fuai/laboratory/fabric_numbers.h"

namespace fuai {
namespace {

/// What a section of the file is multiplied with: nothing, or its elastic part and its friction.
struct SectionFactors {
  const char* section;
  FabricFactor elastic, friction;
};

constexpr SectionFactors kSections[] = {
    {"weight", FabricFactor::kWeight, FabricFactor::kWeight},
    {"bending.warp", FabricFactor::kWarpBending, FabricFactor::kBendingFriction},
    {"bending.weft", FabricFactor::kWeftBending, FabricFactor::kBendingFriction},
    {"shear", FabricFactor::kShear, FabricFactor::kShearFriction},
    {"tensile.warp", FabricFactor::kWarpTension, FabricFactor::kWarpTension},
    {"tensile.weft", FabricFactor::kWeftTension, FabricFactor::kWeftTension},
};

double factor_of(const ViewFabric& fabric, FabricFactor which) {
  return fabric.factors[static_cast<std::size_t>(which)];
}

/// The factors of a section when one of them differs from 1.
const SectionFactors* changed_section(const ViewFabric& fabric, const std::string& section) {
  for (const SectionFactors& s : kSections)
    if (section == s.section && (factor_of(fabric, s.elastic) != 1.0 || factor_of(fabric, s.friction) != 1.0))
      return &s;
  return nullptr;
}

std::string story(const ViewFabric& fabric, const SectionFactors& s) {
  char text[160];
  std::snprintf(text, sizeof text, "measured law times %.4g, its friction times %.4g, chosen in the viewer",
                factor_of(fabric, s.elastic), factor_of(fabric, s.friction));
  return text;
}

}  // namespace

Fabric scaled_fabric(const ViewFabric& fabric) {
  Fabric scaled = fabric.measured;
  if (!fabric.changed()) return scaled;
  const FabricLaws laws = make_view_laws(fabric);
  // Settings of the instrument, such as the tension of the shear test, have no KES quantity and stay.
  for (FabricField& field : fabric_fields(scaled))
    if (field.kes && changed_section(fabric, field.section) != nullptr && field.section != "weight")
      field.value->value = std::numeric_limits<double>::quiet_NaN();
  for (FabricCurveField& field : fabric_curve_fields(scaled))
    if (changed_section(fabric, field.section) != nullptr) field.curve->reset();

  const std::vector<FabricNumber> numbers = fabric_numbers(scaled, laws);
  for (FabricField& field : fabric_fields(scaled)) {
    const SectionFactors* s = changed_section(fabric, field.section);
    if (s == nullptr || !field.kes) continue;
    if (field.section == "weight") {
      *field.value = {laws.areal_mass, {ProvenanceKind::kAssumed, story(fabric, *s), ""}};
      continue;
    }
    const auto number = std::find_if(numbers.begin(), numbers.end(),
                                     [&](const FabricNumber& n) { return n.path() == field.path(); });
    if (number != numbers.end() && number->known.has_value())
      *field.value = {number->known.value, {ProvenanceKind::kAssumed, story(fabric, *s), ""}};
  }
  scaled.name += " (changed)";
  scaled.id += "-changed";
  return scaled;
}

}  // namespace fuai
