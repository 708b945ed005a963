// Fabric files: the documented example, provenance, warnings, errors with their place, and the round trip.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/text_file.h"
#include "fuai/units/constants.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;
using fuai::test::TemporaryFolder;

namespace {

/// The example of the file format's documentation.
const std::string kExample = R"(format = "fuai-fabric/1"
name = "Wool tropical"
composition = "100 % wool, plain weave"
[weight]
W_mg_per_cm2 = 16.29
[thickness]
T_mm = 0.407
[bending.warp]
B_gf_cm2_per_cm = 0.067
2HB_gf_cm_per_cm = 0.033
[shear]
G_gf_per_cm_deg = 0.9
2HG_gf_per_cm = 1.2
2HG5_gf_per_cm = 2.5
[tensile.warp]
LT = 0.62
WT_gf_cm_per_cm2 = 8.1
RT_percent = 68
EMT_percent = 5.2
[surface]
MIU = 0.18
MMD = 0.012
SMD_um = 3.1
[compression]
LC = 0.33
WC_gf_cm_per_cm2 = 0.12
RC_percent = 52
[drape]
drape_coefficient_percent = 49.8
disc_cm = 12.7
specimen_cm = 25.4
[provenance]
"weight" = { kind = "measured", source = "balance" }
"thickness" = { kind = "measured", source = "FB3" }
"bending" = { kind = "measured", source = "FB2", quality = "one specimen" }
"bending.warp.2HB_gf_cm_per_cm" = { kind = "statistic", source = "median" }
"shear" = { kind = "measured", source = "FB1" }
"tensile" = { kind = "measured", source = "FB1" }
"surface" = { kind = "measured", source = "FB4" }
"compression" = { kind = "measured", source = "FB3" }
"drape" = { kind = "measured", source = "drape tester" }
)";

Fabric parse(const std::string& text) { return parse_fabric(text, "dir/wool.fabric.toml", "/nonexistent"); }

/// The example with one part replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text = kExample;
  const std::size_t at = text.find(from);
  REQUIRE_MESSAGE(at != std::string::npos, from);
  return text.replace(at, from.size(), to);
}

std::string message_with(const std::string& from, const std::string& to) {
  return error_of([&] { parse(with(from, to)); }).what();
}

/// The warnings of the example with one part replaced, but for those of the example itself.
std::string warnings_with(const std::string& from, const std::string& to) {
  std::string all;
  for (const std::string& warning : parse(with(from, to)).warnings) all += warning + "\n";
  return all;
}

bool same(const Known& a, const Known& b) {
  if (a.has_value() != b.has_value()) return false;
  return !a.has_value() ||
         (a.value == b.value && a.provenance.kind == b.provenance.kind &&
          a.provenance.source == b.provenance.source && a.provenance.quality == b.provenance.quality);
}

/// Compares everything but the warnings; names the first difference.
std::string difference(Fabric a, Fabric b) {
  if (a.id != b.id || a.name != b.name || a.composition != b.composition || a.note != b.note) return "texts";
  if (a.weave.structure != b.weave.structure) return "structure";
  const auto fields_a = fabric_fields(a), fields_b = fabric_fields(b);
  for (std::size_t i = 0; i < fields_a.size(); ++i) {
    if (!same(*fields_a[i].value, *fields_b[i].value)) return fields_a[i].path();
  }
  const auto curves_a = fabric_curve_fields(a), curves_b = fabric_curve_fields(b);
  for (std::size_t i = 0; i < curves_a.size(); ++i) {
    const auto &x = *curves_a[i].curve, &y = *curves_b[i].curve;
    if (x.has_value() != y.has_value()) return curves_a[i].path();
    if (!x) continue;
    if (x->provenance.source != y->provenance.source || x->curve.branches.size() != y->curve.branches.size())
      return curves_a[i].path();
    for (std::size_t j = 0; j < x->curve.branches.size(); ++j) {
      const auto &p = x->curve.branches[j].samples, &q = y->curve.branches[j].samples;
      const auto equal = [](auto s, auto t) { return s.strain == t.strain && s.stress == t.stress; };
      if (!std::equal(p.begin(), p.end(), q.begin(), q.end(), equal)) return curves_a[i].path();
    }
  }
  return "";
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the documented example, converted to SI by hand") {
    const Fabric fabric = parse(kExample);
    CHECK(fabric.id == "wool");
    CHECK(fabric.name == "Wool tropical");
    CHECK(fabric.composition == "100 % wool, plain weave");
    const auto close = [](const Known& known, double si) { return std::abs(known.value - si) <= 1e-14 * si; };
    CHECK(close(fabric.areal_mass, 0.1629));
    CHECK(close(fabric.thickness, 0.407e-3));
    CHECK(close(fabric.bending[0].B, 0.067 * 9.80665e-5));
    CHECK(close(fabric.bending[0].hysteresis_2HB, 0.033 * 9.80665e-3));
    CHECK(!fabric.bending[1].B.has_value());
    CHECK(close(fabric.shear.G, 0.9 * 0.980665 * 180 / 3.14159265358979323846));
    CHECK(close(fabric.tensile[0].EMT, 0.052));
    CHECK(close(fabric.tensile[0].peak_load, 500 * 0.980665));
    CHECK(fabric.tensile[0].peak_load.provenance.kind == ProvenanceKind::kAssumed);
    CHECK(!fabric.tensile[1].peak_load.has_value());
    CHECK(close(fabric.surface.SMD, 3.1e-6));
    CHECK(close(fabric.compression.WC, 0.12 * 0.980665));
    CHECK(close(fabric.drape.specimen_diameter, 0.254));
    CHECK(fabric.warnings.empty());
  }

  TEST_CASE("the most specific provenance wins; a number without any says so") {
    const Fabric fabric = parse(kExample);
    CHECK(fabric.bending[0].B.provenance.source == "FB2");
    CHECK(fabric.bending[0].B.provenance.quality == "one specimen");
    CHECK(fabric.bending[0].hysteresis_2HB.provenance.kind == ProvenanceKind::kStatistic);
    const Fabric without = parse(with("\"weight\" = { kind = \"measured\", source = \"balance\" }\n", ""));
    CHECK(without.areal_mass.provenance.kind == ProvenanceKind::kMeasured);
    CHECK(without.areal_mass.provenance.source == "stated in wool.fabric.toml, origin not given");
    REQUIRE(without.warnings.size() == 1);
    CHECK(contains(without.warnings[0], "no [provenance] for weight.W_mg_per_cm2"));
    CHECK(contains(warnings_with("\"drape\" = {",
                                 "\"bending.bias\" = { kind = \"fitted\", source = \"x\" }\n\"drape\" = {"),
                   "\"bending.bias\": the file holds nothing that this describes"));
  }

  TEST_CASE("additional keys: note, peak load, tension, node count") {
    std::string text = with("[weight]", "note = \"a \\\"note\\\"\"\n[weight]");
    text.replace(text.find("[shear]"), 7, "[shear]\ntension_gf_per_cm = 0");
    text.replace(text.find("LT = 0.62"), 9, "LT = 0.62\npeak_load_gf_per_cm = 50");
    text.replace(text.find("disc_cm"), 7, "node_count = 6\ndisc_cm");
    const Fabric fabric = parse(text);
    CHECK(fabric.note == "a \"note\"");
    CHECK(fabric.tensile[0].peak_load.value == doctest::Approx(50 * 0.980665).epsilon(1e-14));
    CHECK(fabric.tensile[0].peak_load.provenance.source == "FB1");
    CHECK(fabric.shear.tension.value == 0.0);  // unlike most numbers it may be zero
    CHECK(fabric.shear.tension.provenance.source == "FB1");
    CHECK(fabric.drape.node_count.value == 6.0);
    CHECK(fabric.warnings.size() == 1);  // WT no longer fits
  }

  TEST_CASE("suspicious numbers warn with place, key, range and the likely unit, and the fabric is read") {
    CHECK(contains(
        warnings_with("B_gf_cm2_per_cm = 0.067", "B_gf_cm2_per_cm = 1000"),
        "dir/wool.fabric.toml:9:19: bending.warp.B_gf_cm2_per_cm: 1000 gf·cm²/cm is outside the range of "
        "real "
        "cloth (0.001 to 10 gf·cm²/cm); it would be plausible in g·mm²/s² (CLO), that is 0.0101972"));
    CHECK(contains(warnings_with("W_mg_per_cm2 = 16.29", "W_mg_per_cm2 = 162.9"),
                   "plausible in g/m², that is 16.29 mg/cm²"));
    CHECK(contains(warnings_with("RT_percent = 68", "RT_percent = 0.68"),
                   "plausible in a fraction, that is 68 %"));
    CHECK(contains(warnings_with("T_mm = 0.407", "T_mm = 407"), "plausible in µm, that is 0.407 mm"));
    CHECK(contains(
        warnings_with("WT_gf_cm_per_cm2 = 8.1", "WT_gf_cm_per_cm2 = 12"),
        "tensile.warp: WT = 12 gf·cm/cm² disagrees with LT·Fm·EMT/2 = 8.06 gf·cm/cm² (Fm = 500 gf/cm)"));
    CHECK(warnings_with("WT_gf_cm_per_cm2 = 8.1", "WT_gf_cm_per_cm2 = 8.4").empty());  // within 5 %
    CHECK(contains(warnings_with("specimen_cm = 25.4", "specimen_cm = 12"), "the specimen is not larger"));
    const Fabric fabric = parse(with("B_gf_cm2_per_cm = 0.067", "B_gf_cm2_per_cm = 1000"));
    CHECK(fabric.bending[0].B.value == doctest::Approx(0.0980665));
  }

  TEST_CASE("impossible numbers are refused with line, column, key and cure") {
    CHECK(message_with("W_mg_per_cm2 = 16.29", "W_mg_per_cm2 = -1") ==
          "dir/wool.fabric.toml:5:16: weight.W_mg_per_cm2: -1 mg/cm² is negative; this quantity cannot be "
          "negative: "
          "check the sign");
    CHECK(contains(message_with("= 0.067", "= -0.067"),
                   ":9:19: bending.warp.B_gf_cm2_per_cm: -0.067 gf·cm²/cm is negative"));
    CHECK(contains(message_with("= 0.067", "= nan"),
                   ":9:19: bending.warp.B_gf_cm2_per_cm: the value is not finite"));
    CHECK(contains(message_with("= 0.067", "= inf"), "not finite"));
    CHECK(contains(message_with("= 0.067", "= 4.9e-324"), "not a number that can be measured"));
    CHECK(contains(message_with("= 0.067", "= 1e308"), "not a number that can be measured"));
    CHECK(contains(message_with("EMT_percent = 5.2", "EMT_percent = 0"),
                   "tensile.warp.EMT_percent: the value is zero"));
    CHECK(contains(message_with("EMT_percent = 5.2", "EMT_percent = -2"), "negative"));
    CHECK(contains(message_with("RT_percent = 68", "RT_percent = 168"), "168 % is more than the whole"));
    CHECK(contains(message_with("= 0.067", "= \"0.067\""),
                   "a number is expected, not a text; remove the quotes"));
    CHECK(contains(message_with("= 0.067", "= [1]"), "a number is expected"));
  }

  TEST_CASE("unknown keys name the nearest known one") {
    CHECK(contains(message_with("T_mm", "T_mmm"), ":7:1: thickness.T_mmm: unknown key; write T_mm"));
    CHECK(contains(message_with("[shear]", "[sheer]"),
                   "sheer: unknown section; the nearest known key is shear"));
    CHECK(contains(message_with("composition", "compositon"),
                   ":3:1: compositon: unknown key; the nearest known key is composition"));
    CHECK(contains(message_with("[bending.warp]", "[bending.wrap]"), "bending.wrap"));
    CHECK(contains(message_with("W_mg_per_cm2 = 16.29", "W_g_per_m2 = 162.9"),
                   "unknown key; write W_mg_per_cm2 = 16.29"));
    CHECK(contains(message_with("B_gf_cm2_per_cm = 0.067", "B = 0.067"),
                   "bending.warp.B: unknown key; write B_gf_cm2_per_cm"));
    CHECK(contains(message_with("[tensile.warp]", "[tensile.bias]"), "tensile.bias: unknown section"));
  }

  TEST_CASE("broken files") {
    CHECK(contains(message_with("source = \"balance\" }", ""), "dir/wool.fabric.toml:33:33: "));
    CHECK(contains(message_with("fuai-fabric/1", "fuai-fabric/2"),
                   "1:10: format: the format is 'fuai-fabric/2'"));
    CHECK(contains(message_with("name = \"Wool tropical\"\n", ""), "'name' is missing"));
    CHECK(contains(message_with("format = \"fuai-fabric/1\"\n", ""), "'format' is missing"));
    CHECK(contains(message_with("[weight]\nW_mg_per_cm2 = 16.29\n", ""),
                   "weight.W_mg_per_cm2: the areal mass is missing"));
    CHECK(contains(message_with("[thickness]\nT_mm = 0.407\n", "[[thickness]]\nT_mm = 0.407\n"),
                   "a table is expected"));
    CHECK(contains(
        message_with("kind = \"measured\", source = \"balance\"", "kind = \"guessed\", source = \"x\""),
        "unknown kind 'guessed'; write measured, computed"));
    CHECK(contains(message_with("kind = \"measured\", source = \"balance\"", "kind = \"measured\""),
                   "kind or source is missing"));
    CHECK(contains(message_with("\"weight\" =", "\"wieght\" ="),
                   "names no block or key of a fabric file; the nearest is \"weight\""));
    CHECK(contains(message_with("\"thickness\" =", "thickness.T_mm ="), "a dotted name stands in quotes"));
    CHECK(
        contains(error_of([] { parse("x = " + std::string(5000, '[')); }).what(), "this is no fabric file"));
    CHECK(contains(error_of([] { parse("format = \"fuai-fabric/1\"\nname = \"x\"\nnam"); }).what(),
                   "wool.fabric.toml:3"));
  }

  TEST_CASE("letters beyond ASCII belong into strings and comments") {
    const auto named = [](const std::string& value) { return with("\"Wool tropical\"", value); };
    const auto message = [&](const std::string& value) {
      return std::string(error_of([&] { parse(named(value)); }).what());
    };
    CHECK(contains(message_with("T_mm", "厚さ"),
                   "wool.fabric.toml:7:1: the character '厚' stands outside of quotes"));
    CHECK(contains(message("\"\"\"a\\\n é\"\"\""), ":3:2: the character 'é' follows a continued line"));
    CHECK(contains(message("\"\"\"a\\é\"\"\""), ":2:13: the character 'é' follows a backslash"));
    CHECK(contains(message("a\"é\""), ":2:10: the character 'é' stands inside a word"));
    CHECK(parse(named("\"\"\"\"é\" \\\" \\\n x'\"\"\"  # é")).name == "\"é\" \" x'");
    CHECK(parse(named("'é\\'")).name == "é\\");
    CHECK(parse(named("'''é\n'\\'''")).name == "é\n'\\");
  }

  TEST_CASE("curve files are read from beside the fabric file, and only from there") {
    const TemporaryFolder folder;
    const auto text = [](const std::string& curve) {
      return "format = \"fuai-fabric/1\"\nname = \"x\"\n[weight]\nW_mg_per_cm2 = 10\n[bending.weft]\ncurve = "
             "\"" +
             curve +
             "\"\n[provenance]\nweight = { kind = \"measured\", source = \"s\" }\n\"bending.weft.curve\" = { "
             "kind = "
             "\"measured\", source = \"FB2\" }\n";
    };
    const auto message = [&](const std::string& curve) {
      return std::string(error_of([&] { parse_fabric(text(curve), "f.toml", folder.path()); }).what());
    };
    folder.write("good.csv",
                 "# fuai-curve/1 test=bending direction=weft\ncurvature_per_cm,moment_gf_cm_per_cm,branch\n"
                 "0,0,load\n1,1,load\n2,2,load\n2,1.8,unload\n0,-0.1,unload\n");
    folder.write("bare.csv", "curvature_per_cm,moment_gf_cm_per_cm\n0,0\n1,1\n2,2\n");
    folder.write(
        "warp.csv",
        "# fuai-curve/1 test=bending direction=warp\ncurvature_per_cm,moment_gf_cm_per_cm\n0,0\n1,1\n2,2\n");
    folder.write(
        "crossed.csv",
        "curvature_per_cm,moment_gf_cm_per_cm,branch\n0,0,load\n2,2,load\n2,2.5,unload\n0,0.5,unload\n");
    const Fabric fabric = parse_fabric(text("good.csv"), "f.toml", folder.path());
    REQUIRE(fabric.bending[1].curve.has_value());
    CHECK(fabric.bending[1].curve->curve.branches.size() == 2);
    CHECK(fabric.bending[1].curve->provenance.source == "FB2");
    CHECK(fabric.warnings.empty());
    CHECK(parse_fabric(text("bare.csv"), "f.toml", folder.path()).bending[1].curve->curve.direction ==
          Direction::kWeft);
    const Fabric crossed = parse_fabric(text("crossed.csv"), "f.toml", folder.path());
    REQUIRE(crossed.warnings.size() == 1);
    CHECK(contains(crossed.warnings[0], "branches cross"));
    CHECK(contains(message("warp.csv"), "the file says direction=warp, but weft is asked for"));
    CHECK(contains(message("none.csv"), "f.toml:6:9: bending.weft.curve: the curve file"));
    CHECK(contains(message("none.csv"), "does not exist"));
    for (const char* outside : {"../good.csv", "/etc/passwd", "a/../../good.csv", ""}) {
      CHECK(contains(message(outside), "is no file beside or below the fabric file"));
    }
  }
}

TEST_SUITE("property") {
  TEST_CASE("read(write(f)) == f for the example") {
    const Fabric fabric = parse(kExample);
    const std::string text = format_fabric(fabric);
    CHECK(difference(parse(text), fabric) == "");
    CHECK(format_fabric(parse(text)) == text);
    CHECK(contains(text, "B_gf_cm2_per_cm = 0.067\n"));  // as many digits as were written, no more
    CHECK(parse(text).warnings.empty());
  }

  TEST_CASE("read(write(f)) == f for random fabrics with numbers as a laboratory prints them") {
    CHECK(rc::check("round trip", [] {
      Fabric fabric;
      fabric.id = "random";
      fabric.name = "n\"\\\n\x01 é 布";
      fabric.note = *rc::gen::element(std::string(), std::string("note\twith\x7f tab"));
      if (const int structure = *rc::gen::inRange(-1, kWeaveStructureCount); structure >= 0)
        fabric.weave.structure = static_cast<WeaveStructure>(structure);
      for (const FabricField& field : fabric_fields(fabric)) {
        if (field.key != "W_mg_per_cm2" && *rc::gen::inRange(0, 2) == 0) continue;
        const double number = *rc::gen::inRange(1, 99999) * 1e-3;  // what a laboratory prints
        const auto kind = static_cast<ProvenanceKind>(*rc::gen::inRange(0, 5));
        *field.value = {number * field.to_si,
                        {kind, "source " + std::to_string(*rc::gen::inRange(0, 3)), ""}};
      }
      for (TensileMeasurement& t : fabric.tensile) {
        const bool any = t.LT.has_value() || t.WT.has_value() || t.RT.has_value() || t.EMT.has_value();
        if (any && !t.peak_load.has_value()) t.peak_load = standard_peak_load();
      }
      const std::string text = format_fabric(fabric);
      const Fabric once = parse_fabric(text, "random.fabric.toml", "/nonexistent");
      const std::string found = difference(once, fabric);
      RC_ASSERT(found == "");
      RC_ASSERT(format_fabric(once) == text);
    }));
  }

  TEST_CASE("curves are written beside the fabric file and read back") {
    Fabric fabric = parse(kExample);
    fabric.id = "with-curves";
    double scale = 0.01;  // a different curve everywhere
    for (const FabricCurveField& field : fabric_curve_fields(fabric)) {
      scale *= 1.3;
      const CurveBranch out{Branch::kLoad, {{0.0, 0.0}, {0.1, 4.0 * scale}, {0.2, 9.0 * scale}}};
      const CurveBranch back{Branch::kUnload, {{0.2, 9.0 * scale}, {0.1, 3.5 * scale}, {0.0, -0.1 * scale}}};
      const MeasuredCurve curve{field.test, field.direction, {out, back}, ""};
      *field.curve = KnownCurve{curve, {ProvenanceKind::kMeasured, "drawn " + field.section, ""}};
    }
    fabric.tensile[1].peak_load = standard_peak_load();
    const TemporaryFolder folder;
    const std::string path = folder / "with-curves.fabric.toml";
    write_fabric_file(path, fabric);
    CHECK(folder.entry_count() == 8);  // bending 3, shear, tensile 2, compression, and the fabric file
    const Fabric once = read_fabric_file(path);
    // Values that no file held before may move by two units in the last place; then they stay.
    CHECK(once.bending[2].curve->curve.branches[0].samples[2].stress ==
          doctest::Approx(fabric.bending[2].curve->curve.branches[0].samples[2].stress).epsilon(1e-15));
    write_fabric_file(path, once);
    CHECK(difference(read_fabric_file(path), once) == "");
    CHECK(once.compression.curve->provenance.source == "drawn compression");
    CHECK(once.warnings.empty());
  }

  TEST_CASE("what cannot be read is not written") {
    Fabric fabric;
    CHECK(contains(error_of([&] { format_fabric(fabric); }).what(), "no name"));
    fabric.name = "x";
    CHECK(contains(error_of([&] { format_fabric(fabric); }).what(), "no areal mass"));
    fabric.areal_mass.value = 0.1;
    fabric.thickness.value = HUGE_VAL;
    const TemporaryFolder folder;
    CHECK(contains(error_of([&] { write_fabric_file(folder / "x.toml", fabric); }).what(),
                   "thickness.T_mm: the value is not finite"));
    CHECK(folder.entry_count() == 0);
  }
}
