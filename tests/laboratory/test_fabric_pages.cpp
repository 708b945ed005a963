// Cards and reports: what must stand on them, without a graphics driver.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <algorithm>
#include <string>

#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/comparison_page.h"
#include "fuai/laboratory/fabric_card.h"
#include "fuai/laboratory/fabric_report.h"
#include "fuai/laboratory/study_page.h"

using namespace fuai;

namespace {

Image blank() {
  Image image;
  image.width = image.height = 16;
  image.pixels.assign(std::size_t{4} * 16 * 16, 200);
  return image;
}

const StudyPictures kPictures{blank(), blank(), blank()};

/// A lattice of 2 cm: a tenth of a second a specimen.
DrapeTestOptions coarse(int runs, int band_seeds) {
  DrapeTestOptions options;
  options.geometry.spacing = 0.02;
  options.runs = runs;
  options.band_seeds = band_seeds;
  return options;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("bytes as an address: the examples of RFC 4648") {
    for (const auto& [bytes, code] :
         {std::pair{"", ""}, {"f", "Zg=="}, {"fo", "Zm8="}, {"foo", "Zm9v"}, {"foobar", "Zm9vYmFy"}})
      CHECK(data_uri("text/plain", bytes) == std::string("data:text/plain;base64,") + code);
    CHECK(data_uri("a/b", std::string("\xff\xfe\x00", 3)) == "data:a/b;base64,//4A");
  }

  TEST_CASE("a card holds every number with its kind and source, in KES units and SI") {
    const FabricStudy study = run_fabric_study(load_fabric("wool-tropical"), coarse(2, 1));
    const Sheet sheet = card_sheet(study, kPictures, "1.2.3");
    CHECK(sheet.images.size() == 3);
    std::size_t rows = 0, assumed = 0;
    for (const SheetTable& table : sheet.tables) {
      for (const SheetRow& row : table.rows) {
        ++rows;
        const bool is_assumed = row.cells.back().starts_with("assumed [");
        assumed += is_assumed ? 1 : 0;
        CHECK((is_assumed || row.cells.back().starts_with("measured [")));
        // What nobody measured stands out by its colour too.
        CHECK((row.colour.red > row.colour.blue + 0.2) == is_assumed);
      }
      // Two columns of a page: nothing below its edge.
      CHECK(table.box.top + table.row_height * static_cast<double>(table.rows.size() + 1) <
            sheet.height - 60);
    }
    const auto known =
        std::ranges::count_if(study.numbers, [](const FabricNumber& n) { return n.known.has_value(); });
    CHECK(rows == static_cast<std::size_t>(known));
    CHECK(assumed == 13);  // 2 of the bias, 3 of shear, 8 of tension
    const auto text_with = [&](const std::string& part) {
      return std::ranges::any_of(sheet.texts, [&](const SheetText& text) { return holds(text.text, part); });
    };
    for (const std::string part :
         {"Wool tropical", "162.9 g/m²", "Drape coefficient ", "(2 specimens)", "with what was assumed",
          "disc 18 cm, specimen 30 cm, spacing 20 mm, seeds 0 to 1",
          "measured: 49.8 %, 5 nodes (tester not stated)", "Matsudaira", "fuai 1.2.3"}) {
      CAPTURE(part);
      CHECK(text_with(part));
    }
    CHECK(holds(sheet_svg(sheet), "data:image/png;base64,"));
    const std::string html = card_html(study, kPictures, "1.2.3");
    CHECK(count(html, "src=\"data:image/png;base64,") == 3);
    CHECK(count(html, "src=") == 4);
    CHECK(count(html, "<td>assumed</td>") == 13);
    CHECK(holds(html, "<td>6.57e-06</td>"));
  }

  TEST_CASE("a report holds results, method, settings, seeds, version, sources, input and commands") {
    const std::vector<Fabric> fabrics{load_fabric("cupro-woven-su1098"), load_fabric("cotton-knit-shirley")};
    ReportOptions options;
    options.drape = coarse(2, 0);
    options.drape.seed = 11;
    options.kes = {report_kes_tests()[3]};  // tension: the quick one
    options.version = "1.2.3";
    options.names = {"cupro-woven-su1098", "my dir/knit.toml"};
    options.output = "two.html";
    const FabricReport report = run_fabric_report(fabrics, options);
    CHECK(report.at_rest());
    REQUIRE(report.comparison);
    REQUIRE(report.fabrics[0].kes.size() == 1);
    REQUIRE(report.fabrics[0].kes[0].trip);
    CHECK(report.fabrics[0].kes[0].trip->loop_rms < 0.01);  // issue of the laboratory: 1 % of the peak
    const StudyPictures pictures[] = {kPictures, kPictures};
    const std::string html = report_html(report, options, pictures);
    for (const std::string part :
         {"fuai 1.2.3", "seeds 11 to 12", "Differences from SU-1098 Cupro", "tensile, warp", "loop rms %",
          "Method and settings", "Browzwear Fabric Analyzer", "Tan, Durlach", "shear: measured loop",
          "format = &quot;fuai-fabric/1&quot;",
          "fuai --seed 11 report cupro-woven-su1098 'my dir/knit.toml' --disc 180mm --specimen 300mm "
          "--spacing 20mm --runs 2 --no-bands -o two.html",
          "fuai kes tensile 'my dir/knit.toml' --direction warp"}) {
      CAPTURE(part);
      CHECK(holds(html, part));
    }
    for (const ReportedFabric& fabric : report.fabrics) CHECK(holds(html, fabric.hash));
    // Comparison, and for each fabric three pictures, its loops and the round trips.
    CHECK(count(html, "src=\"data:") == 1 + 2 * 5);
    CHECK(count(html, "src=") == 1 + 2 * 5);
    CHECK_FALSE(holds(html, "href="));
  }

  TEST_CASE("names that are too long for a column give way to the id, signs follow what is shown") {
    Fabric fabric;
    fabric.id = "lot-4711";
    fabric.name = "Tropical";
    CHECK(short_name(fabric) == "Tropical");
    fabric.name = "絹混ウール、二回目の納品分、春のコレクション用";  // 23 characters, 69 bytes
    CHECK(short_name(fabric) == fabric.name);
    fabric.name += "、綾織";
    CHECK(short_name(fabric) == fabric.name);  // 26
    fabric.name += "り";
    CHECK(short_name(fabric) == "lot-4711");
    fabric.id = std::string(40, 'x');
    CHECK(short_name(fabric) == std::string(26, 'x') + "…");
    CHECK(signed_number(0.04, 1) == "0.0");
    CHECK(signed_number(-0.04, 1) == "0.0");
    CHECK(signed_number(-0.06, 1) == "−0.1");
    CHECK(signed_number(12.0, 0) == "+12");
  }

  TEST_CASE("the hash of a fabric sees its numbers and its curves") {
    Fabric fabric = load_fabric("cupro-woven-su1098");
    const std::string hash = fabric_hash(fabric);
    CHECK(hash == fabric_hash(load_fabric("cupro-woven-su1098")));
    fabric.tensile[0].curve->curve.branches[0].samples[3].stress *= 1.0 + 1e-12;
    CHECK(fabric_hash(fabric) != hash);
    fabric = load_fabric("cupro-woven-su1098");
    fabric.bending[1].B.value *= 1.001;
    CHECK(fabric_hash(fabric) != hash);
  }

  TEST_CASE("a report of no fabric, or of seven, is refused before anything runs") {
    const std::vector<Fabric> seven(7, load_fabric("graded-1"));
    CHECK_THROWS_AS(run_fabric_report({}, {}), Error);
    CHECK_THROWS_AS(run_fabric_report(seven, {}), Error);
  }

  TEST_CASE(
      "plots of a comparison: every fabric in each, the law alone, shear within the instrument's range") {
    const FabricStudy cupro = run_fabric_study(load_fabric("cupro-woven-su1098"), coarse(1, 0));
    const FabricStudy wool = run_fabric_study(load_fabric("wool-tropical"), coarse(1, 0));
    const FabricStudy* const studies[] = {&cupro, &wool};
    const PlotGrid grid = comparison_plots(studies);
    REQUIRE(grid.plots.size() == 5);
    for (const Plot& plot : grid.plots) {
      CAPTURE(plot.title);
      REQUIRE(plot.series.size() == 2);
      CHECK(plot.series[0].label == "SU-1098 Cupro");
      CHECK(plot.series[1].label.starts_with("Wool tropical"));
      for (const Series& series : plot.series) CHECK(series.x.size() > 100);
    }
    CHECK(grid.plots[4].series[1].label == "Wool tropical, assumed");
    REQUIRE(grid.plots[4].x_range);
    CHECK(grid.plots[4].x_range->high < 10.0);  // degrees; the cupro's bias strip went to 23
  }
}
