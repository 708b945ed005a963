// Puts the fits of one record together.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/fab_fabric.h"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/fabric/fitted_number.h"
#include "fuai/fabric/kes_parameters.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/units/constants.h"

namespace fuai {

namespace {

constexpr double kAboveNoise = 3.0;  // standard deviations

/// What all the parts share.
struct Context {
  const FabRecord& record;
  Fabric& fabric;
  FabFitReport& report;

  std::string instrument(const std::string& test) const {
    std::string text = "Browzwear Fabric Analyzer, " + test + " of " +
                       record.source.substr(record.source.find_last_of('/') + 1);
    if (!record.source_date.empty()) text += ", " + record.source_date;
    return text;
  }
  void warn(const std::string& sentence) const { fabric.warnings.push_back(sentence); }
  void assume(const std::string& sentence) const { report.assumptions.push_back(sentence); }
};

/// A number with a fixed count of decimals.
std::string decimals(double value, int count) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", count, value);
  return text;
}

/// The vendor's warning on the bending of a direction: "BendRigidityWarp" -> "low-force".
std::string vendor_warning(const FabRecord& record, Direction direction) {
  std::string name = to_string(direction);
  name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  const auto it = record.vendor_warnings.find("BendRigidity" + name);
  return it == record.vendor_warnings.end() ? std::string() : it->second;
}

void add_bending(const Context& c, Direction direction) {
  try {
    BucklingFit fit = fit_buckling(c.record, direction);
    const std::string vendor = vendor_warning(c.record, direction);
    if (!vendor.empty()) fit.quality += "; the vendor marks it " + vendor;
    if (fit.quality.rfind("poor", 0) == 0) {
      c.warn(std::string("bending in ") + to_string(direction) + " is " + fit.quality);
    }
    const std::string source = c.instrument("buckling tests D1 and U1");
    const auto quality = [&](double error, double unit, const char* name) {
      return fit.quality + "; standard error " + decimals(error / unit, 4) + " " + name;
    };
    BendingMeasurement& bending = c.fabric.bending[static_cast<std::size_t>(direction)];
    bending.B = {to_four_digits(fit.B, unit::kGfCm2PerCm),
                 {ProvenanceKind::kFitted, source, quality(fit.B_error, unit::kGfCm2PerCm, "gf cm2/cm")}};
    bending.hysteresis_2HB = {
        to_four_digits(fit.hysteresis_2HB, unit::kGfCmPerCm),
        {ProvenanceKind::kFitted, source, quality(fit.hysteresis_2HB_error, unit::kGfCmPerCm, "gf cm/cm")}};
    c.report.bending.push_back(std::move(fit));
  } catch (const Error& error) {
    c.warn(std::string("no bending in ") + to_string(direction) + ": " + error.problem());
  }
}

void add_clamp_check(const Context& c, Direction direction) {
  try {
    const FabClampCheck check = check_fab_clamps(c.record, direction);
    c.report.clamp_checks.push_back(check);
    c.assume(std::string(to_string(direction)) + ": at " + decimals(check.load / unit::kGfPerCm, 0) +
             " gf/cm the 8 cm strip stretches by " + decimals(100.0 * check.strain_long, 2) +
             " %, the 2 cm strip by " + decimals(100.0 * check.strain_short, 2) + " %: an apparent " +
             decimals(1e3 * check.clamp_length, 2) + " mm in the clamps; the 8 cm strain is used as it is");
  } catch (const Error&) {
    c.assume(std::string(to_string(direction)) +
             ": the clamps could not be checked, there is no 2 cm stretch test");
  }
}

std::optional<FabStretch> add_tensile(const Context& c, Direction direction) {
  try {
    FabStretch stretch = make_fab_stretch(c.record, direction);
    const TensileParameters p = compute_tensile_parameters(stretch.curve);
    const std::string source = c.instrument("stretch test S2");
    const std::string quality = "last cycle, " + decimals(p.peak_load / unit::kGfPerCm, 1) +
                                " gf/cm instead of 500; strain zero uncertain by " +
                                decimals(100.0 * std::abs(stretch.take_up_strain), 2) + " %";
    const auto known = [&](double value) {
      return std::isnan(value) ? Known{} : Known{value, {ProvenanceKind::kComputed, source, quality}};
    };
    TensileMeasurement& tensile = c.fabric.tensile[static_cast<std::size_t>(direction)];
    tensile.LT = known(p.LT);
    tensile.WT = known(p.WT);
    tensile.RT = known(p.RT);
    tensile.EMT = known(p.EMT);
    tensile.peak_load = known(p.peak_load);
    tensile.curve = KnownCurve{stretch.curve, {ProvenanceKind::kMeasured, source, quality}};
    for (const std::string& missing : p.missing) {
      c.warn(std::string("tensile ") + to_string(direction) + ": " + missing);
    }
    c.report.tensile.push_back(stretch);
    add_clamp_check(c, direction);
    return stretch;
  } catch (const Error& error) {
    c.warn(std::string("no tensile curve in ") + to_string(direction) + ": " + error.problem());
    return std::nullopt;
  }
}

/// Loading stress of the first branch at an angle; nothing when it does not reach.
std::optional<double> first_loading_at(const MeasuredCurve& curve, double angle) {
  const std::vector<CurveSample>& s = curve.branches.front().samples;
  for (std::size_t i = 1; i < s.size(); ++i) {
    if (s[i - 1].strain <= angle && s[i].strain > angle) {
      const double t = (angle - s[i - 1].strain) / (s[i].strain - s[i - 1].strain);
      return s[i - 1].stress + t * (s[i].stress - s[i - 1].stress);
    }
  }
  return std::nullopt;
}

void add_shear(const Context& c, const FabStretch& warp, const FabStretch& weft) {
  try {
    FabShear shear = make_fab_shear(make_fab_stretch(c.record, Direction::kBias), warp, weft);
    const std::string source = c.instrument("bias stretch test S2");
    KesReading first;
    first.cycle = 0;
    const ShearParameters p = compute_shear_parameters(shear.curve, first);
    ShearMeasurement& out = c.fabric.shear;
    out.tension = {
        0.0, {ProvenanceKind::kComputed, source, "the shear stress itself: no share of a tension in it"}};
    if (!std::isnan(p.G.face)) {
      out.G = {
          p.G.face,
          {ProvenanceKind::kComputed, source, shear.quality + "; first loading, one side, no loop exists"}};
    }
    // A strip cannot push: on the way back it goes slack before it reaches these angles.
    const auto width = [&](double measured, double angle) -> Known {
      if (!std::isnan(measured)) return {measured, {ProvenanceKind::kComputed, source, shear.quality}};
      const std::optional<double> bound = first_loading_at(shear.curve, angle);
      if (!bound || !(*bound > kAboveNoise * shear.noise)) return {};  // not to be told from noise
      return {*bound,
              {ProvenanceKind::kComputed, source,
               shear.quality + "; lower bound: the first loading alone, the strip is slack on the way back"}};
    };
    out.hysteresis_2HG = width(p.hysteresis_2HG.face, 0.5 * unit::kDegree);
    out.hysteresis_2HG5 = width(p.hysteresis_2HG5.face, 5.0 * unit::kDegree);
    if (shear.quality.rfind("poor", 0) == 0) {
      c.warn("the shear curve is left out, its numbers are doubtful: " + shear.quality);
    } else {
      out.curve = KnownCurve{shear.curve, {ProvenanceKind::kComputed, source, shear.quality}};
    }
    c.report.shear = std::move(shear);
  } catch (const Error& error) {
    c.warn("no shear: " + error.problem());
  }
}

void list_assumptions(const Context& c) {
  c.assume(
      "tensile strain is zero at the free length that the file states; force is zero where the strip hangs "
      "slack");
  c.assume(std::string("bending is linear with a constant friction bound; ") + kBendingPlaysInWords +
           " are assumed");
  c.assume(
      "in each buckling test the load cell has an offset and a linear drift of its own; both clamps share "
      "one tilt");
  c.assume("the first branch of each buckling test is not fitted, for its history is unknown");
  c.assume("shear: homogeneous bias strip, yarns on their last loop, no coupling of warp and weft");
  if (!c.record.thickness_branches.empty()) {
    c.warn("compression is left out: the file does not state the area of the thickness head");
  }
}

}  // namespace

Fabric make_fabric_from_fab(const FabRecord& record, FabFitReport* report) {
  if (!(record.areal_mass > 0.0)) {
    throw Error(ErrorKind::kBadInput, "the file states no areal mass", {record.source, 0, 0, "raw_data.M"});
  }
  FabFitReport own;
  Fabric fabric;
  const Context c{record, fabric, report ? *report : own};
  c.report = {};
  fabric.name = record.name;
  fabric.composition = record.composition;
  fabric.areal_mass = {record.areal_mass, {ProvenanceKind::kMeasured, c.instrument("mass"), ""}};
  if (record.thickness > 0.0) {
    fabric.thickness = {record.thickness,
                        {ProvenanceKind::kMeasured, c.instrument("thickness"), "the pressure is not stated"}};
  }
  list_assumptions(c);
  for (Direction d : {Direction::kWarp, Direction::kWeft, Direction::kBias}) add_bending(c, d);
  const std::optional<FabStretch> warp = add_tensile(c, Direction::kWarp);
  const std::optional<FabStretch> weft = add_tensile(c, Direction::kWeft);
  if (warp && weft) add_shear(c, *warp, *weft);
  c.report.warnings = fabric.warnings;
  return fabric;
}

}  // namespace fuai
