// KES sheets: headers in both languages, units, directions, both orientations, and what is refused.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fuai/io/kes_header.h"
#include "fuai/io/kes_sheet.h"
#include "fuai/units/constants.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;
using fuai::test::TemporaryFolder;

namespace {

std::vector<Fabric> parse(const std::string& text) { return parse_kes_sheet(text, "dir/s.csv"); }

std::string message_of(const std::string& text) {
  return error_of([&] { parse(text); }).what();
}

std::string warnings_of(const Fabric& fabric) {
  std::string all;
  for (const std::string& warning : fabric.warnings) all += warning + "\n";
  return all;
}

/// Whether a header is read as a quantity with a direction.
bool reads(const char* header, Kes quantity, std::optional<Direction> direction) {
  const SheetHeader h = read_sheet_header(header);
  return h.role == SheetRole::kQuantity && h.quantity == quantity && h.direction == direction;
}

bool close(const Known& known, double si) { return std::abs(known.value - si) <= 1e-14 * std::abs(si); }

const auto kWarp = Direction::kWarp;
const auto kWeft = Direction::kWeft;

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("headers: every documented spelling of quantity and direction") {
    for (const char* header : {"B1",
                               "B-1",
                               "B_1",
                               "B 1",
                               "B_warp",
                               "B warp",
                               "B-warp",
                               "warp B",
                               "B (warp)",
                               "B(たて)",
                               "経B",
                               "Bたて",
                               "たてB",
                               "B（経）",
                               "Ｂ－１",
                               "曲げ剛性(たて)",
                               "たて曲げ剛性",
                               "曲げ剛性 タテ",
                               "bending rigidity warp",
                               "Bending Rigidity (Warp) [gf·cm²/cm]",
                               "B1 [gf cm2/cm]",
                               "B_warp_gf_cm2_per_cm"}) {
      CAPTURE(std::string(header));
      CHECK(reads(header, Kes::kB, kWarp));
    }
    for (const char* header :
         {"B2", "B-2", "B_weft", "B(よこ)", "緯B", "曲げ剛性(緯)", "曲げかたさ（ヨコ）"}) {
      CAPTURE(std::string(header));
      CHECK(reads(header, Kes::kB, kWeft));
    }
    CHECK(reads("2HB1", Kes::k2HB, kWarp));
    CHECK(reads("2HG5", Kes::k2HG5, std::nullopt));
    CHECK(reads("2HG5-2", Kes::k2HG5, kWeft));
    CHECK(reads("せん断ヒステリシス (0.5°)", Kes::k2HG, std::nullopt));
    CHECK(reads("せん断ヒステリシス(5度)", Kes::k2HG5, std::nullopt));
    CHECK(reads("shear hysteresis at 5 deg", Kes::k2HG5, std::nullopt));
    CHECK(reads("WT", Kes::kWT, std::nullopt));
    CHECK(reads("引張仕事量", Kes::kWT, std::nullopt));
    CHECK(reads("せん断剛性", Kes::kG, std::nullopt));
    CHECK(reads("厚さ(mm)", Kes::kT, std::nullopt));
    CHECK(reads("重さ[mg/cm2]", Kes::kW, std::nullopt));
    CHECK(reads("目付 (g/m2)", Kes::kW, std::nullopt));
    CHECK(reads("EMT (バイアス)", Kes::kEMT, Direction::kBias));
    CHECK(reads("W_mg_per_cm2", Kes::kW, std::nullopt));
    CHECK(read_sheet_header("B mean").is_mean);
    for (const char* header : {"date", "Tm", "t", "B factor", "", "derived_HB_over_B_per_cm"}) {
      CAPTURE(std::string(header));
      CHECK(read_sheet_header(header).role == SheetRole::kUnread);
    }
    // Every symbol and name of the table of quantities is understood.
    for (const KesQuantity& q : kes_quantities()) {
      for (const std::string_view name : {q.symbol, q.name_en, q.name_ja}) {
        CAPTURE(std::string(name));
        CHECK(read_sheet_header(name).quantity == q.id);
        CHECK(read_sheet_header(name).role == SheetRole::kQuantity);
      }
    }
  }

  TEST_CASE("one fabric a row, units in brackets, converted by hand") {
    const auto fabrics = parse(
        "name,B_warp [cN·cm²/cm],B_weft [mN·mm],2HB(たて) [gf·cm/cm],G [N/(m·rad)],W [g/m2],T (mm),EMT_warp "
        "(%),LT_warp\n"
        "Wool Tropical,0.05,4,0.033,50,162.9,0.407,5.2,0.62\n"
        "絹,0.01,1,,20,50,0.1,3,0.8\n");
    REQUIRE(fabrics.size() == 2);
    CHECK(fabrics[0].id == "wool-tropical");
    CHECK(fabrics[1].id == "fabric-2");
    CHECK(fabrics[1].name == "絹");
    CHECK(close(fabrics[0].bending[0].B, 0.05 * 1e-2 * 1e-2));
    CHECK(close(fabrics[0].bending[1].B, 4e-6));
    CHECK(close(fabrics[0].bending[0].hysteresis_2HB, 0.033 * 9.80665e-3));
    CHECK(!fabrics[1].bending[0].hysteresis_2HB.has_value());
    CHECK(close(fabrics[0].shear.G, 50.0));
    CHECK(close(fabrics[0].areal_mass, 0.1629));
    CHECK(close(fabrics[0].tensile[0].EMT, 0.052));
    CHECK(close(fabrics[0].tensile[0].peak_load, 490.3325));
    CHECK(fabrics[0].bending[0].B.provenance.kind == ProvenanceKind::kMeasured);
    CHECK(fabrics[0].bending[0].B.provenance.source == "KES sheet s.csv, Wool Tropical");
    CHECK(fabrics[0].warnings.empty());
  }

  TEST_CASE("a second header row may hold the units") {
    const auto fabrics = parse("試料;B1;B2;W;LT1\n;gf·cm²/cm;(cN·cm²/cm);g/m²;-\nA;0,067;0,05;162,9;0,6\n");
    REQUIRE(fabrics.size() == 1);
    CHECK(close(fabrics[0].bending[0].B, 0.067 * 9.80665e-5));
    CHECK(close(fabrics[0].bending[1].B, 0.05e-4));
    CHECK(close(fabrics[0].areal_mass, 0.1629));
    CHECK(contains(warnings_of(fabrics[0]),
                   "column 'B1' is read as the warp (1 is the warp, 2 the weft in Kato's usage)"));
    CHECK(!contains(warnings_of(fabrics[0]), "no unit stated"));
  }

  TEST_CASE("one fabric a column, with a column of units") {
    const auto fabrics = parse(
        "項目,単位,Wool,Silk\nB(たて),gf·cm²/cm,0.067,0.01\nB(よこ),gf·cm²/cm,0.05,0.02\n重さ,mg/"
        "cm²,16.29,5\n");
    REQUIRE(fabrics.size() == 2);
    CHECK(fabrics[0].name == "Wool");
    CHECK(close(fabrics[1].bending[1].B, 0.02 * 9.80665e-5));
    CHECK(close(fabrics[0].areal_mass, 0.1629));
    CHECK(contains(warnings_of(fabrics[0]), "('項目') are taken for the fabrics' names"));
    const Error error = error_of([] { parse("項目,Wool,Silk\nB1,0.067,x\n重さ,16.29,5\n"); });
    CHECK(contains(error.what(), "dir/s.csv:2:10: B1: 'x' is not a number"));
  }

  TEST_CASE("CP932, full-width letters, tabs") {
    const TemporaryFolder folder;
    // 試料名 <tab> ２ＨＢ（たて） <tab> 重さ(g/m2); then 毛 0.05 160
    const std::string path =
        folder.write("kes.txt",
                     "\x8E\x8E\x97\xBF\x96\xBC\t\x82\x51\x82\x67\x82\x61\x81\x69\x82\xBD\x82\xC4\x81\x6A\t"
                     "\x8F\x64\x82\xB3(g/m2)\r\n\x96\xD1\t0.05\t160\r\n");
    const auto fabrics = read_kes_sheet(path);
    REQUIRE(fabrics.size() == 1);
    CHECK(fabrics[0].name == "毛");
    CHECK(close(fabrics[0].bending[0].hysteresis_2HB, 0.05 * 9.80665e-3));
    CHECK(close(fabrics[0].areal_mass, 0.16));
  }

  TEST_CASE("keys with glued units, no direction, further columns: a published table") {
    const auto fabrics = parse(
        "fabric,name,composition_weave,B_gfcm2_per_cm,2HB_gfcm_per_cm,G_gf_per_cmdeg,W_mg_per_cm2,T_mm,"
        "drape_coefficient_pct,node_count,derived_residual_curvature_HB_over_B_per_cm\n"
        "B,Wool Tropical,100% wool plain weave,0.067,0.033,,16.29,0.407,49.8,5,0.246\n"
        "F,Polyester Faille,,0.019,0.007,,10.43,0.226,28.3,7,0.184\n");
    REQUIRE(fabrics.size() == 2);
    const Fabric& f = fabrics[0];
    CHECK(f.name == "Wool Tropical");
    CHECK(f.composition == "100% wool plain weave");
    // Whatever the spelling of the KES unit, the factor is that of the table, so that 0.067 is written back
    // as 0.067.
    CHECK(f.bending[0].B.value == 0.067 * kes_quantity(Kes::kB).to_si);
    CHECK(f.bending[1].B.value == f.bending[0].B.value);
    CHECK(!f.shear.G.has_value());
    CHECK(close(f.drape.drape_coefficient, 0.498));
    CHECK(f.drape.node_count.value == 5.0);
    CHECK(contains(warnings_of(f),
                   "column 'B_gfcm2_per_cm' states no direction and is taken for warp and weft"));
    CHECK(contains(warnings_of(f), "not read: 'derived_residual_curvature_HB_over_B_per_cm'"));
  }

  TEST_CASE("shear by direction is averaged, a mean beside warp and weft is not read") {
    const auto fabrics = parse("name,G1,G2,B_warp,B_weft,B mean,W\nA,0.8,1.2,0.1,0.2,0.15,10\n");
    const Fabric& f = fabrics.at(0);
    CHECK(close(f.shear.G, unit::kGfPerCmDeg));
    CHECK(f.shear.G.provenance.kind == ProvenanceKind::kComputed);
    CHECK(contains(f.shear.G.provenance.source, "mean of warp and weft"));
    CHECK(close(f.bending[1].B, 0.2 * 9.80665e-5));
    CHECK(contains(warnings_of(f), "'G1' and 'G2' are averaged"));
    CHECK(contains(warnings_of(f), "column 'B mean' is not read"));
    CHECK(contains(warnings_of(f), "no unit stated; taken as KES units: G1 in gf/(cm·deg)"));
  }

  TEST_CASE("values outside the range of real cloth warn with their cell") {
    const auto fabrics = parse("name,B_warp [gf·cm²/cm],W [mg/cm2]\nA,0.1,162.9\n");
    CHECK(
        contains(warnings_of(fabrics.at(0)), "dir/s.csv:2:7: W [mg/cm2]: 162.9 mg/cm² is outside the range"));
    CHECK(contains(warnings_of(fabrics.at(0)), "plausible in g/m²"));
  }

  TEST_CASE("names may repeat or be missing") {
    const auto fabrics = parse("name,B1,W\nA,0.1,10\nA,0.1,10\n,0.1,10\n");
    CHECK(fabrics[1].id == "a-2");
    CHECK(fabrics[2].name == "s 3");
  }

  TEST_CASE("ambiguity and mistakes are errors with place, key and cure") {
    CHECK(contains(message_of("name,ヒステリシス,B1,W\nA,1,1,1\n"),
                   "dir/s.csv:1:6: the header 'ヒステリシス' is ambiguous; write the symbol: 2HB"));
    CHECK(contains(message_of("name,shear hysteresis,B1,W\nA,1,1,1\n"), "write the symbol: 2HG or 2HG5"));
    CHECK(contains(message_of("name,B1,B_warp,W\nA,1,1,1\n"),
                   "'B1' and 'B_warp' are both read as the same number"));
    CHECK(contains(message_of("name,B,B_warp,W\nA,1,1,1\n"), "both read as the same number"));
    CHECK(contains(message_of("name,G,G1,W\nA,1,1,1\n"), "both read as the same number"));
    CHECK(contains(message_of("name,W,重さ\nA,1,1\n"), "both read as the same number"));
    CHECK(contains(message_of("name,B1 [g/m2],W\nA,1,1\n"),
                   "dir/s.csv:1:6: B1 [g/m2]: the unit does not measure B"));
    CHECK(contains(message_of("name,B1 (furlong),W\nA,1,1\n"), "'furlong' in brackets"));
    CHECK(contains(message_of("name,B (W),W\nA,1,1\n"), "has 'W' in brackets"));
    CHECK(contains(message_of("name,B1 [gf·cm²/cm],W\n,gf·cm²/cm,mg/cm²\nA,1,1\n"),
                   "stands in the header and below it"));
    CHECK(contains(message_of("name,EMT (bias),W\nA,1,1\n"), "no tensile test on the bias"));
    CHECK(contains(message_of("name,T (warp),W\nA,1,1\n"), "T has no such direction"));
    CHECK(contains(message_of("name,B1,W\nA,-0.1,10\n"), "dir/s.csv:2:3: B1: -0.1 gf·cm²/cm is negative"));
    CHECK(contains(message_of("name,B1,W\nA,nan,10\n"), "'nan' is not a finite number"));
    CHECK(contains(message_of("name,B1,W\nA,0.1,\n"), "'A' has no areal mass; add a column W"));
    CHECK(contains(message_of("name,B1,W\n"), "holds no fabric below its header"));
    CHECK(contains(message_of("a,b\n1,2\n"), "no header names a KES quantity"));
    CHECK(contains(message_of("B\nA\n"), "unclear whether the fabrics stand in rows or in columns"));
  }
}
