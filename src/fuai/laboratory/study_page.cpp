// Writes about a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/study_page.h"

#include <algorithm>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/io/number_text.h"
#include "fuai/laboratory/drape_files.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

constexpr int kLoopsWidth = 900, kLoopsHeight = 640;  // [pt]

/// "bending warp"
std::string spaced(std::string section) {
  std::ranges::replace(section, '.', ' ');
  return section;
}

}  // namespace

std::string SourceList::number_of(const Provenance& provenance) {
  const std::string quality =
      brief_ ? provenance.quality.substr(0, provenance.quality.find(';')) : provenance.quality;
  const std::string text = provenance.source + (quality.empty() ? "" : " (" + quality + ")");
  auto found = std::ranges::find(entries_, text);
  if (found == entries_.end()) found = entries_.insert(found, text);
  return "[" + std::to_string(found - entries_.begin() + 1) + "]";
}

HtmlTable number_table(const FabricStudy& study, SourceList& sources) {
  HtmlTable table;
  table.header = {"quantity", "symbol", "value", "unit", "SI value", "SI unit", "kind", "setting", "source"};
  for (const FabricNumber& n : study.numbers) {
    if (!n.known.has_value()) continue;
    const KesQuantity& q = n.definition();
    table.rows.push_back({spaced(n.section) + ": " + std::string(q.name_en), std::string(q.symbol),
                          shown_number(n.in_kes_units()), std::string(q.kes_unit),
                          shown_number(n.known.value), std::string(q.si_unit),
                          to_string(n.known.provenance.kind), n.condition,
                          sources.number_of(n.known.provenance)});
  }
  return table;
}

void add_drape(HtmlPage& page, const FabricStudy& study, const StudyPictures& pictures) {
  const DrapeTest& test = study.drape;
  const auto png = [](const Image& image) { return data_uri("image/png", encode_png(image)); };
  const std::string measured = measured_drape_in_words(study.fabric);
  page.gallery({{png(pictures.side), "from the side"},
                {png(pictures.top), "from above"},
                {png(pictures.shadow), "shadow; circle: the flat specimen, dots: nodes"}},
               study.fabric.name + ": " + drape_in_words(test) + ". The pictures show the specimen nearest " +
                   "to the mean (seed " + std::to_string(test.typical().seed) + "); " +
                   drape_setting_in_words(test) + (measured.empty() ? "" : ". Drape " + measured) + ".");
}

void add_loops(HtmlPage& page, const FabricStudy& study) {
  PlotGrid grid = fabric_plot(study.fabric, study.laws);
  grid.title.clear();
  page.figure(
      data_uri("image/svg+xml", plot_svg(grid, kLoopsWidth, kLoopsHeight)),
      study.fabric.name + ": loops of the laws that are simulated, and measured points where there are any.",
      "loops of bending, shear and tension");
}

void add_assumptions(HtmlPage& page, const FabricStudy& study) {
  std::vector<std::string> items;
  for (const LawReport& report : study.laws.reports) {
    std::string text = report.law + ": " + report.origin;
    if (report.origin == "measured loop")
      text += ", rms residual " + brief_number(100.0 * report.rms_residual_fraction, 3) + " % of the peak";
    for (const std::string& sentence : report.assumptions) text += "; " + sentence;
    items.push_back(text);
  }
  for (const std::string& sentence : study.drape.assumptions) {
    // Those of the laws stand above.
    const bool of_law = std::ranges::any_of(
        study.laws.reports, [&](const LawReport& report) { return sentence.starts_with(report.law + ": "); });
    if (!of_law) items.push_back("drape: " + sentence);
  }
  for (const std::string& warning : study.fabric.warnings) items.push_back("warning: " + warning);
  page.list(items);
}

void add_sources(HtmlPage& page, const SourceList& sources) {
  std::vector<std::string> items;
  for (std::size_t i = 0; i < sources.entries().size(); ++i)
    items.push_back("[" + std::to_string(i + 1) + "] " + sources.entries()[i]);
  page.list(items);
}

std::string introduction(const Fabric& fabric) {
  std::string measured;
  for (const std::string& block : measured_blocks(fabric)) measured += (measured.empty() ? "" : ", ") + block;
  return fabric.name + " (" + fabric.id + ")" +
         (fabric.composition.empty() ? "" : ", " + fabric.composition) + ", " +
         shown_number(fabric.areal_mass.value / unit::kGPerM2) +
         " g/m². Measured on this very cloth: " + (measured.empty() ? "nothing" : measured) + "." +
         (fabric.note.empty() ? "" : " " + fabric.note);
}

}  // namespace fuai
