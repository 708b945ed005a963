// Curve files: every accepted spelling, the split into branches, the round trip, and what is refused.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <rapidcheck.h>

#include <cmath>
#include <string>

#include "fuai/io/curve_csv.h"
#include "fuai/io/text_file.h"
#include "fuai/units/constants.h"
#include "io/io_test_tools.h"

using namespace fuai;
using fuai::test::contains;
using fuai::test::error_of;
using fuai::test::TemporaryFolder;

namespace {

const std::string kBending =
    "# fuai-curve/1 test=bending direction=weft\n"
    "curvature_per_cm,moment_gf_cm_per_cm,branch\n"
    "0,0.01,load\n1,0.08,load\n2,0.15,load\n2,0.14,unload\n1,0.05,unload\n0,-0.01,unload\n0.5,0.04,load\n1,0."
    "07,load\n";

std::string message_of(const std::string& text, const CurveCsvOptions& options = {}) {
  return error_of([&] { parse_curve_csv(text, "c.csv", options); }).what();
}

/// The message for the good file with one part replaced.
std::string message_with(const std::string& from, const std::string& to) {
  std::string text = kBending;
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return message_of(text.replace(at, from.size(), to));
}

/// First strain and last stress of the first branch, to compare units.
void check_first_branch(const std::string& text, const CurveCsvOptions& options, double strain,
                        double stress) {
  CAPTURE(text);
  const MeasuredCurve curve = parse_curve_csv(text, "c.csv", options);
  REQUIRE(!curve.branches.empty());
  CHECK(curve.branches[0].samples[1].strain == doctest::Approx(strain).epsilon(1e-14));
  CHECK(curve.branches[0].samples[1].stress == doctest::Approx(stress).epsilon(1e-14));
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("the documented form: branches in the order measured, any number of cycles") {
    const MeasuredCurve curve = parse_curve_csv(kBending, "c.csv");
    CHECK(curve.test == Test::kBending);
    CHECK(curve.direction == Direction::kWeft);
    CHECK(curve.source == "c.csv");
    REQUIRE(curve.branches.size() == 3);
    CHECK(curve.branches[0].kind == Branch::kLoad);
    CHECK(curve.branches[1].kind == Branch::kUnload);
    CHECK(curve.branches[2].kind == Branch::kLoad);
    CHECK(curve.branches[1].samples.size() == 3);
    CHECK(curve.branches[0].samples[2].strain == doctest::Approx(200.0).epsilon(1e-14));
    CHECK(curve.branches[0].samples[2].stress == doctest::Approx(0.15 * 9.80665e-3).epsilon(1e-14));
    CHECK(curve_warnings(curve).empty());
  }

  TEST_CASE("units of the header: suffix, brackets, Japanese, cN for gf, radians for degrees") {
    const CurveCsvOptions bending{Test::kBending, Direction::kWarp};
    const std::string rows = "\n0,0\n1,2\n2,3\n";
    check_first_branch("curvature [1/cm],moment (cN·cm/cm)" + rows, bending, 100.0, 2e-2);
    check_first_branch("K (1/m),M [mN]" + rows, bending, 1.0, 2e-3);
    check_first_branch("曲率（1/cm）,曲げモーメント［gf.cm/cm］" + rows, bending, 100.0,
                       2 * unit::kGramForce);
    check_first_branch("curvature_per_cm,bending_moment_cN_cm_per_cm" + rows, bending, 100.0, 2e-2);
    const CurveCsvOptions shear{Test::kShear, {}};
    check_first_branch("angle_deg,force_gf_per_cm" + rows, shear, unit::kDegree, 2 * unit::kGfPerCm);
    check_first_branch("angle (rad),force (N/m)" + rows, shear, 1.0, 2.0);
    check_first_branch("せん断角[deg],せん断力[gf/cm]" + rows, shear, unit::kDegree, 2 * unit::kGfPerCm);
    const CurveCsvOptions tensile{Test::kTensile, Direction::kWarp};
    check_first_branch("strain_percent,force_gf_per_cm" + rows, tensile, 0.01, 2 * unit::kGfPerCm);
    check_first_branch("伸び率(%),荷重(cN/cm)" + rows, tensile, 0.01, 2.0);
    const CurveCsvOptions compression{Test::kCompression, {}};
    check_first_branch("thickness_loss_mm,pressure_gf_per_cm2" + rows, compression, 1e-3,
                       2 * unit::kGfPerCm2);
  }

  TEST_CASE("tabs, semicolons with decimal commas, CP932, byte order mark, titles and further columns") {
    const CurveCsvOptions bending{Test::kBending, Direction::kWarp};
    check_first_branch("Title;x\nno;curvature [1/cm];moment [gf cm/cm]\n1;0,0;0,0\n2;0,5;0,25\n3;1,0;0,5\n",
                       bending, 50.0, 0.25 * unit::kGramForce);
    check_first_branch("curvature [1/cm]\tmoment [gf cm/cm]\n0\t0\n0.5\t0.25\n1\t0.5\n", bending, 50.0,
                       0.25 * unit::kGramForce);
    const TemporaryFolder folder;
    // 曲率(1/cm),モーメント(gf·cm/cm) in CP932, CRLF line ends; CP932 writes the product sign as 0x8145.
    const std::string path =
        folder.write("sjis.csv",
                     "\x8B\xC8\x97\xA6(1/cm),\x83\x82\x81[\x83\x81\x83\x93\x83g(gf\x81\x45"
                     "cm/cm)\r\n0,0\r\n1,2\r\n2,3\r\n");
    const MeasuredCurve curve = read_curve_csv(path, bending);
    CHECK(curve.branches[0].samples[1].stress == doctest::Approx(2 * unit::kGramForce).epsilon(1e-14));
    const MeasuredCurve marked = read_curve_csv(folder.write("bom.csv", "\xEF\xBB\xBF" + kBending));
    CHECK(marked.branches.size() == 3);
  }

  TEST_CASE("without a branch column the strain's turning points split the recording") {
    // Noise of 0.5 % of the range does not count as a turn.
    std::string text = "# fuai-curve/1 test=bending direction=warp\ncurvature_per_cm,moment_gf_cm_per_cm\n";
    for (const double k : {0.0, 1.0, 0.98, 2.0, 2.5, 1.0, -1.0, -2.5, 0.0, 2.5})
      text += std::to_string(k) + "," + std::to_string(k) + "\n";
    const MeasuredCurve curve = parse_curve_csv(text, "c");
    REQUIRE(curve.branches.size() == 3);
    CHECK(curve.branches[0].kind == Branch::kLoad);
    CHECK(curve.branches[0].samples.size() == 5);
    CHECK(curve.branches[1].kind == Branch::kUnload);
    CHECK(curve.branches[1].samples.size() == 4);  // the turning sample is in both
    CHECK(curve.branches[1].samples[0].strain == doctest::Approx(250.0));
    CHECK(curve.branches[2].kind == Branch::kLoad);
    CHECK(curve.branches[2].samples.back().strain == doctest::Approx(250.0));
    // A recording that starts at the far end begins with unloading.
    const MeasuredCurve back = parse_curve_csv(
        "# fuai-curve/1 test=bending "
        "direction=warp\ncurvature_per_cm,moment_gf_cm_per_cm\n2,2\n1,1\n0,0\n1,1\n",
        "c");
    CHECK(back.branches[0].kind == Branch::kUnload);
    CHECK(back.branches[1].kind == Branch::kLoad);
  }

  TEST_CASE("crossed branches are warned about, an elastic curve is not") {
    const std::string head = "# fuai-curve/1 test=shear\nangle_deg,force_gf_per_cm,branch\n";
    const std::string swapped = head + "0,0,load\n4,3,load\n8,8,load\n8,8,unload\n4,5,unload\n0,0.5,unload\n";
    const auto warnings = curve_warnings(parse_curve_csv(swapped, "s.csv"));
    REQUIRE(warnings.size() == 1);
    CHECK(contains(warnings[0], "s.csv: the branches cross: unloading branch 2 lies above"));
    const std::string elastic = head + "0,0,load\n4,4,load\n8,8,load\n8,8,unload\n4,4,unload\n0,0,unload\n";
    CHECK(curve_warnings(parse_curve_csv(elastic, "s.csv")).empty());
    // Towards negative strain the way back must lie above.
    const std::string negative = head + "0,0,load\n-8,-8,load\n-8,-8,unload\n-4,-2,unload\n0,1,unload\n";
    CHECK(curve_warnings(parse_curve_csv(negative, "s.csv")).empty());
  }

  TEST_CASE("what is wrong is named with line, column, key and cure") {
    CHECK(contains(message_with("1,0.08,load", "1,nan,load"),
                   "c.csv:4:3: moment_gf_cm_per_cm: 'nan' is not a finite"));
    CHECK(contains(message_with("1,0.08,load", "x,0.08,load"),
                   "c.csv:4:1: curvature_per_cm: 'x' is not a number"));
    CHECK(contains(message_with("2,0.14,unload", "2,0.14,sideways"),
                   "c.csv:6:8: branch: 'sideways' is no branch; write"));
    CHECK(contains(message_with("2,0.14,unload", "2,0.14"), "c.csv:6:1: the line has 2 cells"));
    CHECK(contains(message_with("1,0.08,load\n2,0.15,load\n", ""),
                   "c.csv:3: branch: this branch has one sample"));
    CHECK(contains(message_with("curvature_per_cm", "curvature"),
                   "c.csv:2:1: curvature: the column states no unit; write"));
    CHECK(contains(message_with("curvature_per_cm", "curvature_deg"), "does not measure this quantity"));
    CHECK(contains(message_with("curvature_per_cm", "curvature_furlong"), "the unit cannot be read"));
    CHECK(contains(message_with("moment_gf_cm_per_cm", "moment [g cm/cm]"), "a gram of force is gf"));
    CHECK(
        contains(message_with("curvature_per_cm", "bend"), "no header names the columns of a bending curve"));
    CHECK(contains(message_with(",branch", ",K [1/cm]"), "two columns, 'curvature_per_cm' and 'K [1/cm]'"));
    CHECK(contains(message_with("test=bending", "test=folding"),
                   "c.csv:1:1: unknown test 'folding'; use one of bending"));
    CHECK(contains(message_with("direction=weft", "direction=left"), "unknown direction 'left'"));
    CHECK(contains(message_with("direction=weft", "speed=3"), "unknown word 'speed=3'"));
    CHECK(contains(message_with(" direction=weft", ""), "does not say in which direction"));
    CHECK(contains(message_with("fuai-curve/1", "fuai-curve/9"), "unknown format 'fuai-curve/9'"));
    CHECK(contains(message_with("# fuai-curve/1 test=bending direction=weft\n", ""),
                   "does not say which test"));
    CHECK(contains(message_of(kBending, {Test::kShear, {}}),
                   "the file says test=bending, but shear is asked for"));
    const std::string head = "# fuai-curve/1 test=shear\nangle_deg,force_gf_per_cm\n";
    CHECK(contains(message_of(head + "0,0\n1,1\n"), "there are 2 samples"));
    CHECK(contains(message_of(head + "1,0\n1,1\n1,2\n"), "the strain never changes"));
    CHECK(contains(message_of(head + "1,0\n2,0\n3,0\n"), "the stress is zero everywhere"));
    CHECK(contains(message_of(head + "0,0\n1,-1\n2,-2\n"), "a negative stiffness"));
    CHECK(contains(message_with("1,0.08,load", "1e308,0.08,load"),
                   "c.csv:4:1: curvature_per_cm: the value is too large"));
  }
}

TEST_SUITE("property") {
  TEST_CASE("what is written comes back: within 1e-12 for any value, exactly for values once read") {
    CHECK(rc::check("round trip", [] {
      MeasuredCurve curve;
      curve.test = *rc::gen::element(Test::kBending, Test::kShear, Test::kTensile, Test::kCompression);
      curve.direction = *rc::gen::element(Direction::kWarp, Direction::kWeft, Direction::kBias);
      const int branches = *rc::gen::inRange(1, 4);
      for (int b = 0; b < branches; ++b) {
        CurveBranch branch{b % 2 == 0 ? Branch::kLoad : Branch::kUnload, {}};
        const int samples = *rc::gen::inRange(3, 20);
        for (int i = 0; i < samples; ++i) {
          const double s = (b % 2 == 0 ? i : samples - 1 - i) + *rc::gen::inRange(0, 1000) * 1e-5;
          branch.samples.push_back({s / 7.0, (s * s + s + *rc::gen::inRange(0, 100) * 1e-3) / 3.0});
        }
        curve.branches.push_back(branch);
      }
      const std::string text = format_curve_csv(curve);
      const MeasuredCurve once = parse_curve_csv(text, "c");
      RC_ASSERT(once.test == curve.test);
      RC_ASSERT(once.direction == curve.direction);
      RC_ASSERT(once.branches.size() == curve.branches.size());
      for (std::size_t b = 0; b < once.branches.size(); ++b) {
        RC_ASSERT(once.branches[b].kind == curve.branches[b].kind);
        RC_ASSERT(once.branches[b].samples.size() == curve.branches[b].samples.size());
        for (std::size_t i = 0; i < once.branches[b].samples.size(); ++i) {
          const CurveSample &x = once.branches[b].samples[i], &y = curve.branches[b].samples[i];
          RC_ASSERT(std::abs(x.strain - y.strain) <= 1e-12 * std::abs(y.strain));
          RC_ASSERT(std::abs(x.stress - y.stress) <= 1e-12 * std::abs(y.stress));
        }
      }
      const MeasuredCurve twice = parse_curve_csv(format_curve_csv(once), "c");
      for (std::size_t b = 0; b < once.branches.size(); ++b) {
        for (std::size_t i = 0; i < once.branches[b].samples.size(); ++i) {
          RC_ASSERT(twice.branches[b].samples[i].strain == once.branches[b].samples[i].strain);
          RC_ASSERT(twice.branches[b].samples[i].stress == once.branches[b].samples[i].stress);
        }
      }
    }));
  }

  TEST_CASE("a curve file is written whole") {
    const TemporaryFolder folder;
    const MeasuredCurve curve = parse_curve_csv(kBending, "c.csv");
    write_curve_csv(folder / "out.csv", curve);
    CHECK(read_text_file(folder / "out.csv") == kBending);
  }

  TEST_CASE("branches that move against their names are reported, those that overrun zero are not") {
    const std::string head =
        "# fuai-curve/1 test=bending direction=warp\ncurvature_per_cm,moment_gf_cm_per_cm,branch\n";
    const auto warnings = [&](const std::string& rows) {
      return curve_warnings(parse_curve_csv(head + rows, "c.csv"));
    };
    const auto swapped = warnings("0,0,unload\n1,1,unload\n1,0.9,load\n0,-0.1,load\n");
    REQUIRE(swapped.size() == 2);
    CHECK(contains(swapped[0], "branch 1 is called unload but moves away from zero"));
    CHECK(contains(swapped[1], "branch 2 is called load but moves towards zero"));
    CHECK(warnings("-0.1,0,load\n1,1,load\n1,0.9,unload\n-0.2,-0.3,unload\n").empty());
    CHECK(warnings("-1,-1,load\n1,1,load\n1,0.9,unload\n-1,-1,unload\n").empty());  // full swings
  }
}
