// Lists the numbers of a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_numbers.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "fuai/fabric/cycle_comparison.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/number_text.h"
#include "fuai/laboratory/kes_round_trip.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

std::string block_of(const std::string& section) { return section.substr(0, section.find('.')); }

Direction direction_of(const std::string& section) {
  return section.ends_with(".weft") ? Direction::kWeft
                                    : (section.ends_with(".bias") ? Direction::kBias : Direction::kWarp);
}

/// A law from strain 0 to each turn, one branch a way.
MeasuredCurve law_along(const PlayLaw& law, Test test, Direction direction, std::span<const double> turns) {
  constexpr int kCount = 401;
  MeasuredCurve path;
  path.test = test;
  path.direction = direction;
  double from = 0.0;
  for (const double to : turns) {
    CurveBranch branch{std::abs(to) > std::abs(from) ? Branch::kLoad : Branch::kUnload, {}};
    for (int k = 0; k < kCount; ++k) branch.samples.push_back({from + (to - from) * k / (kCount - 1), 0.0});
    path.branches.push_back(std::move(branch));
    from = to;
  }
  return compare_cycles(law, path).predicted;
}

/// What the instrument would read off the law of a section.
std::vector<KesValue> read_off_law(const FabricLaws& laws, const std::string& section) {
  const std::string block = block_of(section);
  const Direction direction = direction_of(section);
  const auto i = static_cast<std::size_t>(direction);
  if (block == "bending") {
    const double turns[] = {kKesBendingRange, 0.0, -kKesBendingRange, 0.0};
    return read_kes_parameters(law_along(laws.bending[i], Test::kBending, direction, turns));
  }
  if (block == "shear") {
    const double turns[] = {kes_shear_range(), 0.0, -kes_shear_range(), 0.0};
    return read_kes_parameters(
        to_shear_force(law_along(laws.shear, Test::kShear, direction, turns), laws.shear_test));
  }
  const double turns[] = {laws.tensile[i].elastic().high(), 0.0};
  return read_kes_parameters(law_along(laws.tensile[i], Test::kTensile, direction, turns));
}

double value_in(const std::vector<KesValue>& values, Kes quantity) {
  const auto found = std::ranges::find(values, quantity, &KesValue::quantity);
  return found == values.end() ? NAN : found->value;
}

/// The rule that stands for a number, out of the report of its law.
std::string rule_of(const FabricLaws& laws, const std::string& law, std::string_view symbol) {
  std::string rules;
  for (const LawReport& report : laws.reports) {
    if (report.law != law) continue;
    for (const std::string& sentence : report.assumptions) {
      if (sentence.starts_with(std::string(symbol) + " was not measured")) return sentence;
      if (sentence.starts_with("play radii")) continue;
      rules += (rules.empty() ? "" : "; ") + sentence;
    }
  }
  return rules.empty() ? "rules of docs/theory/assumptions.md" : rules;
}

std::string tension_in_words(double load, const char* before) {
  return before + brief_number(std::round(load / unit::kGfPerCm * 10.0) / 10.0) + " gf/cm";
}

constexpr const char* kTesterNotStated = "tester not stated";

/// The setting at which a quantity was read, as far as settings differ.
std::string condition_of(const Fabric& fabric, const FabricLaws& laws, const std::string& section) {
  const std::string block = block_of(section);
  if (block == "tensile") {
    const auto i = static_cast<std::size_t>(direction_of(section));
    const Known& stated = fabric.tensile[i].peak_load;
    return tension_in_words(stated.has_value() ? stated.value : standard_peak_load().value, "to ");
  }
  if (block == "shear") {
    const double tension = laws.shear_test.tension;
    return tension == 0.0 ? "stress, no tension" : tension_in_words(tension, "under ");
  }
  if (block != "drape") return {};
  const DrapeMeasurement& d = fabric.drape;
  if (!d.disc_diameter.has_value() || !d.specimen_diameter.has_value()) return kTesterNotStated;
  return brief_number(d.disc_diameter.value / unit::kCentimetre) + " and " +
         brief_number(d.specimen_diameter.value / unit::kCentimetre) + " cm";
}

/// Fills numbers that the file leaves out.
class Filler {
 public:
  Filler(Fabric& fabric, const FabricLaws& laws) : laws_(laws), curves_(fabric_curve_fields(fabric)) {}

  Known fill(const Fabric& fabric, const FabricNumber& number) {
    const std::string block = block_of(number.section);
    if (number.quantity == Kes::kT)
      return {laws_.thickness, {ProvenanceKind::kAssumed, rule_of(laws_, "thickness", "thickness"), ""}};
    if (block != "bending" && block != "shear" && block != "tensile") return {};
    for (const FabricCurveField& field : curves_) {
      if (field.section != number.section || !*field.curve) continue;
      const double value = value_in(read_kes_parameters((*field.curve)->curve), number.quantity);
      if (!std::isnan(value))
        return {value, {ProvenanceKind::kComputed, (*field.curve)->provenance.source, ""}};
    }
    if (section_ != number.section) {
      section_ = number.section;
      values_ = read_off_law(laws_, section_);
    }
    const double value = value_in(values_, number.quantity);
    if (number.quantity == Kes::kWT) {
      const TensileMeasurement& t = fabric.tensile[static_cast<std::size_t>(direction_of(number.section))];
      if (t.LT.has_value() && t.EMT.has_value())
        return {value, {ProvenanceKind::kComputed, "follows from LT and EMT", ""}};
    }
    const std::string rule = rule_of(laws_, number.section, number.definition().symbol);
    return {value, {ProvenanceKind::kAssumed, rule, ""}};
  }

 private:
  const FabricLaws& laws_;
  std::vector<FabricCurveField> curves_;
  std::string section_;  // whose law was read last
  std::vector<KesValue> values_;
};

}  // namespace

std::vector<FabricNumber> fabric_numbers(const Fabric& fabric, const FabricLaws& laws) {
  Fabric copy = fabric;  // the fields point into it
  Filler filler(copy, laws);
  std::vector<FabricNumber> numbers;
  for (const FabricField& field : fabric_fields(copy)) {
    if (!field.kes) continue;
    FabricNumber number{*field.kes, field.section, *field.value, condition_of(fabric, laws, field.section)};
    number.setting_known = number.condition != kTesterNotStated;
    if (!number.known.has_value()) number.known = filler.fill(fabric, number);
    numbers.push_back(std::move(number));
  }
  return numbers;
}

bool is_evidence(const Provenance& provenance) noexcept {
  return provenance.kind != ProvenanceKind::kAssumed && provenance.kind != ProvenanceKind::kStatistic;
}

std::vector<std::string> measured_blocks(const Fabric& fabric) {
  Fabric copy = fabric;
  std::vector<std::string> blocks;
  for (const FabricField& field : fabric_fields(copy)) {
    if (!field.kes || !field.value->has_value() || !is_evidence(field.value->provenance)) continue;
    const std::string block = block_of(field.section);
    if (std::ranges::find(blocks, block) == blocks.end()) blocks.push_back(block);
  }
  return blocks;
}

std::string main_source(const Fabric& fabric) {
  Fabric copy = fabric;
  for (const FabricField& field : fabric_fields(copy)) {
    if (field.section.starts_with("bending") && field.value->has_value())
      return field.value->provenance.source;
  }
  return fabric.areal_mass.provenance.source;
}

}  // namespace fuai
