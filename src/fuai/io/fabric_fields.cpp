// The one list of everything a fabric file can hold, and where it stands in a Fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/fabric_fields.h"

#include <cmath>

#include "fuai/io/nearest_name.h"
#include "fuai/io/number_text.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

FieldRange range_of(Kes id) {
  switch (id) {
    case Kes::k2HB:
    case Kes::k2HG:
    case Kes::k2HG5:
    case Kes::kMIU:
    case Kes::kMMD:
    case Kes::kSMD:
      return FieldRange::kNotNegative;
    case Kes::kRT:
    case Kes::kRC:
    case Kes::kDrapeCoefficient:
      return FieldRange::kUpToHundred;
    default:
      return FieldRange::kPositive;
  }
}

FabricField kes_field(const std::string& direction, Kes id, Known& value) {
  const KesQuantity& q = kes_quantity(id);
  const std::string section = std::string(q.block) + (direction.empty() ? "" : "." + direction);
  return {section, std::string(q.key), std::string(q.kes_unit), q.to_si, id, range_of(id), &value};
}

/// Units in which a quantity is sometimes written by mistake, with their SI value.
struct OtherUnit {
  Kes id;
  const char* unit;
  double to_si;
};

constexpr OtherUnit kOtherUnits[] = {
    {Kes::kB, "µN·m", 1e-6},         {Kes::kB, "g·mm²/s² (CLO)", 1e-9},
    {Kes::kB, "N·m", 1.0},           {Kes::k2HB, "mN", 1e-3},
    {Kes::k2HB, "N", 1.0},           {Kes::kW, "g/m²", unit::kGPerM2},
    {Kes::kW, "kg/m²", 1.0},         {Kes::kT, "µm", 1e-6},
    {Kes::kT, "cm", 1e-2},           {Kes::kT, "m", 1.0},
    {Kes::kG, "N/(m·rad)", 1.0},     {Kes::kSMD, "mm", 1e-3},
    {Kes::kEMT, "a fraction", 1.0},  {Kes::kRT, "a fraction", 1.0},
    {Kes::kRC, "a fraction", 1.0},   {Kes::kMIU, "%", unit::kPercent},
    {Kes::kLT, "%", unit::kPercent}, {Kes::kDrapeCoefficient, "a fraction", 1.0},
};

/// "; 1000 would be plausible in g·mm²/s² (CLO), that is 0.0101972 gf·cm²/cm", or nothing.
std::string unit_hint(const KesQuantity& q, double number) {
  std::vector<std::string> hints;
  for (const OtherUnit& other : kOtherUnits) {
    const double converted = number * other.to_si / q.to_si;
    if (other.id != q.id || converted < q.plausible_low || converted > q.plausible_high) continue;
    hints.push_back(std::string(other.unit) + ", that is " + brief_number(converted) + " " +
                    std::string(q.kes_unit));
  }
  if (hints.empty()) return "; check the number and its unit";
  return "; it would be plausible in " + either(hints);
}

void check_tensile(const TensileMeasurement& tensile, const std::string& place,
                   std::vector<std::string>& warnings) {
  const double fm = tensile.peak_load.has_value() ? tensile.peak_load.value : standard_peak_load().value;
  if (!tensile.LT.has_value() || !tensile.WT.has_value() || !tensile.EMT.has_value()) return;
  constexpr double kTolerance = 0.05;  // printed digits of the three numbers; a wrong unit is off by far more
  const double expected = tensile.LT.value * fm * tensile.EMT.value / 2.0;
  if (std::abs(tensile.WT.value - expected) <= kTolerance * expected) return;
  const double to_kes = 1.0 / unit::kGfCmPerCm2;
  warnings.push_back(place + ": WT = " + brief_number(tensile.WT.value * to_kes) +
                     " gf·cm/cm² disagrees with LT·Fm·EMT/2 = " + brief_number(expected * to_kes) +
                     " gf·cm/cm² (Fm = " + brief_number(fm / unit::kGfPerCm) +
                     " gf/cm); check the three numbers and peak_load_gf_per_cm");
}

}  // namespace

Known standard_peak_load() {
  constexpr double kPeakLoad = 500.0;  // [gf/cm], KES-FB1 standard setting
  return {
      kPeakLoad * unit::kGfPerCm,
      {ProvenanceKind::kAssumed, "standard setting of KES-FB1, 500 gf/cm; the file states no peak load", ""}};
}

void assume_peak_loads(Fabric& fabric) {
  for (TensileMeasurement& tensile : fabric.tensile) {
    const bool measured = tensile.LT.has_value() || tensile.WT.has_value() || tensile.RT.has_value() ||
                          tensile.EMT.has_value() || tensile.curve.has_value();
    if (measured && !tensile.peak_load.has_value()) tensile.peak_load = standard_peak_load();
  }
}

std::vector<FabricField> fabric_fields(Fabric& fabric) {
  std::vector<FabricField> fields;
  const auto add = [&](const std::string& direction, Kes id, Known& value) {
    fields.push_back(kes_field(direction, id, value));
  };
  const auto setting = [&](const std::string& section, const char* key, const char* unit, double to_si,
                           FieldRange range, Known& value) {
    fields.push_back({section, key, unit, to_si, std::nullopt, range, &value});
  };
  add("", Kes::kW, fabric.areal_mass);
  add("", Kes::kT, fabric.thickness);
  for (int d = 0; d < kDirectionCount; ++d) {
    BendingMeasurement& bending = fabric.bending[static_cast<std::size_t>(d)];
    add(to_string(static_cast<Direction>(d)), Kes::kB, bending.B);
    add(to_string(static_cast<Direction>(d)), Kes::k2HB, bending.hysteresis_2HB);
  }
  add("", Kes::kG, fabric.shear.G);
  add("", Kes::k2HG, fabric.shear.hysteresis_2HG);
  add("", Kes::k2HG5, fabric.shear.hysteresis_2HG5);
  setting("shear", "tension_gf_per_cm", "gf/cm", unit::kGfPerCm, FieldRange::kNotNegative,
          fabric.shear.tension);
  for (std::size_t d = 0; d < fabric.tensile.size(); ++d) {
    TensileMeasurement& tensile = fabric.tensile[d];
    const std::string direction = to_string(static_cast<Direction>(d));
    add(direction, Kes::kLT, tensile.LT);
    add(direction, Kes::kWT, tensile.WT);
    add(direction, Kes::kRT, tensile.RT);
    add(direction, Kes::kEMT, tensile.EMT);
    setting("tensile." + direction, "peak_load_gf_per_cm", "gf/cm", unit::kGfPerCm, FieldRange::kPositive,
            tensile.peak_load);
  }
  add("", Kes::kMIU, fabric.surface.MIU);
  add("", Kes::kMMD, fabric.surface.MMD);
  add("", Kes::kSMD, fabric.surface.SMD);
  add("", Kes::kLC, fabric.compression.LC);
  add("", Kes::kWC, fabric.compression.WC);
  add("", Kes::kRC, fabric.compression.RC);
  add("", Kes::kDrapeCoefficient, fabric.drape.drape_coefficient);
  setting("drape", "node_count", "-", 1.0, FieldRange::kNotNegative, fabric.drape.node_count);
  setting("drape", "disc_cm", "cm", unit::kCentimetre, FieldRange::kPositive, fabric.drape.disc_diameter);
  setting("drape", "specimen_cm", "cm", unit::kCentimetre, FieldRange::kPositive,
          fabric.drape.specimen_diameter);
  setting("weave", "warp_threads_per_cm", "1/cm", unit::kPerCentimetre, FieldRange::kPositive,
          fabric.weave.warp_threads);
  setting("weave", "weft_threads_per_cm", "1/cm", unit::kPerCentimetre, FieldRange::kPositive,
          fabric.weave.weft_threads);
  return fields;
}

std::vector<FabricCurveField> fabric_curve_fields(Fabric& fabric) {
  std::vector<FabricCurveField> fields;
  for (int d = 0; d < kDirectionCount; ++d) {
    const auto direction = static_cast<Direction>(d);
    fields.push_back({std::string("bending.") + to_string(direction), Test::kBending, direction,
                      &fabric.bending[static_cast<std::size_t>(d)].curve});
  }
  fields.push_back({"shear", Test::kShear, Direction::kWarp, &fabric.shear.curve});
  for (std::size_t d = 0; d < fabric.tensile.size(); ++d) {
    const auto direction = static_cast<Direction>(d);
    fields.push_back({std::string("tensile.") + to_string(direction), Test::kTensile, direction,
                      &fabric.tensile[d].curve});
  }
  fields.push_back({"compression", Test::kCompression, Direction::kWarp, &fabric.compression.curve});
  return fields;
}

void check_field(const FabricField& field, double number, const Where& where,
                 std::vector<std::string>& warnings) {
  const auto fail = [&](const std::string& what, const std::string& cure) {
    throw Error(ErrorKind::kBadInput, what, where, cure);
  };
  const std::string unit = field.unit == "-" ? "" : " " + field.unit;
  const std::string shown = brief_number(number) + unit;
  if (!std::isfinite(number))
    fail("the value is not finite", "write a finite number, or leave the key out when it was not measured");
  // Numbers that overflow or vanish on the way to SI and back are no measurements.
  constexpr double kSmallest = 1e-300, kLargest = 1e300;
  for (const double value : {std::abs(number), std::abs(number * field.to_si)}) {
    if (number != 0.0 && (value < kSmallest || value > kLargest))
      fail(shown + " is not a number that can be measured", "check the exponent");
  }
  if (number < 0.0) fail(shown + " is negative", "this quantity cannot be negative: check the sign");
  if (number == 0.0 && field.range == FieldRange::kPositive)
    fail("the value is zero", "write the measured number, or leave the key out when it was not measured");
  if (number > 100.0 && field.range == FieldRange::kUpToHundred)
    fail(shown + " is more than the whole", "write a percentage from 0 to 100");
  if (!field.kes) return;
  const KesQuantity& q = kes_quantity(*field.kes);
  if (number >= q.plausible_low && number <= q.plausible_high) return;
  warnings.push_back(to_string(where) + shown + " is outside the range of real cloth (" +
                     brief_number(q.plausible_low) + " to " + brief_number(q.plausible_high) + unit + ")" +
                     unit_hint(q, number));
}

void check_consistency(Fabric& fabric, const std::string& name) {
  for (std::size_t d = 0; d < fabric.tensile.size(); ++d) {
    check_tensile(fabric.tensile[d], name + ": tensile." + to_string(static_cast<Direction>(d)),
                  fabric.warnings);
  }
  const DrapeMeasurement& drape = fabric.drape;
  if (drape.disc_diameter.has_value() && drape.specimen_diameter.has_value() &&
      drape.specimen_diameter.value <= drape.disc_diameter.value) {
    fabric.warnings.push_back(name + ": drape: the specimen is not larger than the disc");
  }
}

}  // namespace fuai
