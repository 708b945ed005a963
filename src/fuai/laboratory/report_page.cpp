// Writes the report's page.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "fuai/io/fabric_file.h"
#include "fuai/io/number_text.h"
#include "fuai/laboratory/comparison_page.h"
#include "fuai/laboratory/fabric_report.h"
#include "fuai/laboratory/study_page.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai {
namespace {

constexpr int kPlotWidth = 440, kPlotHeight = 320;  // of one panel [pt]

std::string percent(double fraction) { return fixed_number(100.0 * fraction, 1); }

std::string direction_of(const KesTest& test) {
  if (!test.direction) return test.test == Test::kShear ? "mean of warp and weft" : "warp";
  return to_string(*test.direction);
}

void add_plots(HtmlPage& page, const PlotGrid& grid, const std::string& caption,
               const std::string& alternative) {
  const int rows = (static_cast<int>(grid.plots.size()) + grid.columns - 1) / grid.columns;
  page.figure(data_uri("image/svg+xml", plot_svg(grid, kPlotWidth * grid.columns, kPlotHeight * rows)),
              caption, alternative);
}

HtmlTable drape_overview(const FabricReport& report) {
  HtmlTable table;
  table.header = {"fabric", "drape coefficient %", "with assumptions %",
                  "nodes",  "node amplitude mm",   "measured"};
  for (const ReportedFabric& fabric : report.fabrics) {
    const DrapeTest& test = fabric.study.drape;
    double amplitude = 0.0;
    for (const DrapeSample& sample : test.samples) amplitude += sample.run.shadow.mean_amplitude();
    amplitude /= static_cast<double>(test.samples.size());
    std::string measured = measured_drape_in_words(fabric.study.fabric);
    if (measured.starts_with("measured: ")) measured.erase(0, 10);
    table.rows.push_back(
        {short_name(fabric.study.fabric),
         percent(test.coefficient.mean) +
             (test.samples.size() > 1 ? " ± " + percent(test.coefficient.deviation) : ""),
         test.bands.empty() ? "–" : percent(test.band_low) + " to " + percent(test.band_high),
         fixed_number(test.nodes.mean, 1), fixed_number(amplitude / unit::kMillimetre, 1),
         measured.empty() ? "–" : measured});
  }
  return table;
}

HtmlTable specimens(const DrapeTest& test) {
  HtmlTable table;
  table.header = {"seed", "drape coefficient %", "nodes", "node amplitude mm", "out of balance", "at rest"};
  for (const DrapeSample& sample : test.samples) {
    const DrapeRun& run = sample.run;
    table.rows.push_back({std::to_string(sample.seed), fixed_number(100.0 * run.shadow.coefficient, 2),
                          std::to_string(run.shadow.nodes.size()),
                          fixed_number(run.shadow.mean_amplitude() / unit::kMillimetre, 2),
                          brief_number(run.residual, 2), run.at_rest ? "yes" : "no"});
  }
  return table;
}

HtmlTable bands(const DrapeTest& test) {
  HtmlTable table;
  table.header = {"assumed", "at the lower end, points", "at the upper end, points"};
  const auto points = [](double x) { return signed_number(100.0 * x, 1); };
  for (const DrapeBand& band : test.bands)
    table.rows.push_back({band.what, points(band.at_least), points(band.at_most)});
  return table;
}

HtmlTable kes_table(const ReportedFabric& fabric) {
  HtmlTable table;
  table.header = {"test", "symbol", "fabric", "simulated", "unit", "difference %", "loop rms %"};
  for (const ReportedTest& reported : fabric.kes) {
    const std::string name = std::string(to_string(reported.test.test)) + ", " + direction_of(reported.test);
    if (!reported.trip) {
      table.rows.push_back({name + ": " + reported.failure, "", "", "", "", "", ""});
      continue;
    }
    const KesRoundTrip& trip = *reported.trip;
    for (std::size_t i = 0; i < trip.simulated.size(); ++i) {
      const KesQuantity& q = kes_quantity(trip.simulated[i].quantity);
      const double own = trip.input[i].value, simulated = trip.simulated[i].value;
      const double difference = 100.0 * (simulated - own) / own;
      table.rows.push_back({name, std::string(q.symbol), shown_number(own / q.to_si),
                            shown_number(simulated / q.to_si), std::string(q.kes_unit),
                            std::isfinite(difference) ? signed_number(difference, 3) : "–",
                            i == 0 ? fixed_number(100.0 * trip.loop_rms, 3) : ""});
    }
  }
  return table;
}

void add_kes(HtmlPage& page, const ReportedFabric& fabric) {
  if (fabric.kes.empty()) return;
  page.subheading("KES round trip");
  page.table(kes_table(fabric));
  PlotGrid grid;
  grid.columns = 2;
  for (const ReportedTest& reported : fabric.kes) {
    if (!reported.trip) continue;
    grid.plots.push_back(kes_plot(fabric.study.fabric, *reported.trip));
    grid.plots.back().title = std::string(to_string(reported.test.test)) + ", " + direction_of(reported.test);
  }
  if (grid.plots.empty()) return;
  add_plots(page, grid,
            "The loop that the simulated instrument records over the loop of the fabric. Loop rms: distance "
            "of the two, in percent of the peak.",
            "simulated loops over those of the fabric");
}

void add_fabric(HtmlPage& page, const ReportedFabric& fabric, const StudyPictures& pictures,
                SourceList& sources) {
  const FabricStudy& study = fabric.study;
  page.paragraph(introduction(study.fabric));
  page.subheading("Drape");
  add_drape(page, study, pictures);
  page.table(specimens(study.drape));
  if (!study.drape.bands.empty()) page.table(bands(study.drape));
  page.subheading("Numbers");
  page.table(number_table(study, sources));
  page.subheading("Loops");
  add_loops(page, study);
  add_kes(page, fabric);
  page.subheading("What the laws were made from, and what was assumed");
  add_assumptions(page, study);
}

void add_comparison(HtmlPage& page, const FabricReport& report) {
  const FabricComparison& comparison = *report.comparison;
  page.heading("Comparison");
  page.subheading("Numbers in KES units, and their kind");
  page.table(value_table(comparison));
  page.subheading("Differences from " + short_name(comparison.fabrics.front()));
  const HtmlTable differences = difference_table(comparison);
  if (!differences.rows.empty()) page.table(differences);
  page.paragraph(
      "jnd: just-noticeable differences, how many times the threshold of a hand lies between the two; for a "
      "threshold of so many percent equal ratios count as equal steps. A quantity without a threshold has "
      "none that is known. There is no difference where one side is assumed or unknown, or where the two "
      "were read at other settings (another load, tension or tester). The thresholds:");
  page.list(threshold_sentences(comparison));
  std::vector<const FabricStudy*> studies;
  for (const ReportedFabric& fabric : report.fabrics) studies.push_back(&fabric.study);
  add_plots(page, comparison_plots(studies),
            "The laws that are simulated, one plot a test. Laws that are assumed by the same rule hide each "
            "other.",
            "loops of all fabrics");
}

const char* path_in_words(DrapePath path) {
  switch (path) {
    case DrapePath::kRamp:
      return "the weight grows smoothly from nothing";
    case DrapePath::kRelease:
      return "the cloth is let go at once";
    case DrapePath::kShakes:
      return "the weight grows smoothly from nothing, then the disc is moved up and down";
    case DrapePath::kSupport:
      return "the cloth lies on a plate that is lowered";
  }
  return "";
}

void add_method(HtmlPage& page, const ReportOptions& options, const FabricReport& report) {
  const DrapeMethod& m = options.drape.method;
  const auto seconds = [](double t) { return brief_number(t, 4) + " s"; };
  page.heading("Method and settings");
  std::vector<std::string> items{
      "Laws: each measured loop, or the scalars where there is no loop, becomes a law with friction that "
      "gives "
      "them back; what nobody measured is assumed by rule and listed.",
      "Drape: a round lattice of yarns with the fabric's mass, bending, shear and tension lies on a disc; " +
          std::string(path_in_words(m.path)) + " (" + seconds(m.loading) + ", steps of " + seconds(m.dt) +
          "), drag " + brief_number(m.loading_drag, 4) + " /s then and " + brief_number(m.settling_drag, 4) +
          " /s until it rests: the coefficient spreads by less than " + brief_number(100.0 * kRestSpread, 4) +
          " points over " + seconds(kRestWindow) + ", forces are in balance to " +
          brief_number(kRestResidual, 4) +
          " of a node's weight. Here: " + drape_setting_in_words(report.fabrics.front().study.drape) +
          "; each seed lays the lattice elsewhere and makes the cloth a little uneven.",
      "Drape coefficient: (shadow - disc) / (specimen - disc), areas. ± is the standard deviation over the "
      "specimens. With assumptions: twist and shear that nobody measured at the ends of their ranges, summed "
      "with the deviation as squares."};
  if (!options.kes.empty()) {
    items.emplace_back(
        "KES round trip: the same laws on a simulated specimen of 20 cm width in the instrument (bending 1 "
        "cm "
        "long to 2.5 /cm, shear 5 cm to 8 degrees under 10 gf/cm, tension 5 cm to the fabric's largest "
        "load); "
        "the code that reads measured curves reads the simulated one.");
  }
  items.push_back(
      "Program: fuai " + options.version +
      ". The same version on the same instruction set gives the same numbers, whatever the number "
      "of threads.");
  page.list(items);
}

void add_input(HtmlPage& page, const FabricReport& report) {
  page.heading("Input");
  page.paragraph(
      "The fabric files as they were read, and a hash over each with its measured curves: the same hash, the "
      "same input.");
  for (const ReportedFabric& fabric : report.fabrics) {
    page.subheading(fabric.study.fabric.id + ": " + fabric.hash);
    page.listing(format_fabric(fabric.study.fabric));
  }
}

/// A word as a shell takes it.
std::string quoted(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("._-/=+,").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string safe = "'";
  for (const char c : word) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return safe + "'";
}

/// "5mm": with as few decimals as bring the length back exactly.
std::string in_millimetres(double length) {
  constexpr int kMostDecimals = 9;
  for (int decimals = 0; decimals <= kMostDecimals; ++decimals) {
    std::string text = fixed_number(length / unit::kMillimetre, decimals) + "mm";
    if (parse_value(text, kLength, "length") == length) return text;
  }
  return number_text(length, unit::kMillimetre) + "mm";
}

}  // namespace

std::string repeating_commands(const ReportOptions& options) {
  const DrapeTestOptions& d = options.drape;
  const std::string head = "fuai --seed " + std::to_string(d.seed) + " ";
  const std::string test = " --disc " + in_millimetres(d.geometry.disc) + " --specimen " +
                           in_millimetres(d.geometry.specimen) + " --spacing " +
                           in_millimetres(d.geometry.spacing) + " --runs " + std::to_string(d.runs) +
                           (d.band_seeds == 0 ? " --no-bands" : "");
  std::string names;
  for (const std::string& name : options.names) names += " " + quoted(name);
  std::string text = head + "report" + names + test + (options.kes.empty() ? " --no-kes" : "") + " -o " +
                     quoted(options.output);
  if (options.names.size() > 1) text += "\nfuai fabric compare" + names;
  for (const std::string& name : options.names) {
    text += "\nfuai fabric show " + quoted(name);
    text.append("\n").append(head).append("drape ").append(quoted(name)).append(test);
    for (const KesTest& kes : options.kes) {
      text += std::string("\nfuai kes ") + to_string(kes.test) + " " + quoted(name);
      if (kes.direction) text += std::string(" --direction ") + to_string(*kes.direction);
    }
  }
  return text;
}

std::string report_html(const FabricReport& report, const ReportOptions& options,
                        std::span<const StudyPictures> pictures) {
  std::string title;
  for (const ReportedFabric& fabric : report.fabrics)
    title += (title.empty() ? "" : ", ") + fabric.study.fabric.name;
  HtmlPage page(title);
  const std::string about = report.comparison
                                ? "a comparison of " + std::to_string(report.fabrics.size()) + " fabrics"
                                : std::string("one fabric");
  page.paragraph("Report of fuai " + options.version + ", " + about +
                 ": numbers with where each comes from, drape, loops, " +
                 (options.kes.empty() ? "" : "the virtual KES instruments, ") +
                 "and all that is needed to repeat it.");
  if (report.comparison) {
    page.heading("Drape");
    page.table(drape_overview(report));
    add_comparison(page, report);
  }
  SourceList sources;
  for (std::size_t i = 0; i < report.fabrics.size(); ++i) {
    if (report.comparison) page.heading(report.fabrics[i].study.fabric.name);
    add_fabric(page, report.fabrics[i], pictures[i], sources);
  }
  add_method(page, options, report);
  page.heading("Sources of the numbers");
  add_sources(page, sources);
  page.heading("Commands that repeat it");
  page.listing(repeating_commands(options));
  add_input(page, report);
  return page.html();
}

}  // namespace fuai
