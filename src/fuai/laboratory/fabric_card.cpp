// Lays out the fabric card.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_card.h"

#include <algorithm>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/laboratory/study_page.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

// The page, in points; sides as those of A4, so that it prints on one sheet.
constexpr int kWidth = 760, kHeight = 1075;
constexpr double kMargin = 24.0, kInner = kWidth - 2.0 * kMargin;
constexpr double kPicturesTop = 72.0, kPicturesHeight = 172.0;
constexpr double kDrapeTop = kPicturesTop + kPicturesHeight + 16.0;
constexpr double kPlotsTop = kDrapeTop + 40.0, kPlotsHeight = 440.0;
constexpr double kTablesTop = kPlotsTop + kPlotsHeight + 8.0;
constexpr double kRowHeight = 14.0;

constexpr Colour kGrey{0.38, 0.38, 0.40, 1.0};
constexpr Colour kAssumed{0.72, 0.30, 0.02, 1.0};  ///< what nobody measured on this cloth

void add_head(Sheet& sheet, const FabricStudy& study) {
  const Fabric& fabric = study.fabric;
  constexpr std::size_t kLong = 60;  // bytes; a line of large letters holds no more
  const bool is_long = fabric.name.size() > kLong;
  sheet.texts.push_back(
      {{kMargin, is_long ? 22.0 : 16.0, kInner, 30.0}, fabric.name, is_long ? 13.0 : 20.0, true});
  const std::string line = fabric.id + (fabric.composition.empty() ? "" : " · " + fabric.composition) +
                           " · " + shown_number(fabric.areal_mass.value / unit::kGPerM2) + " g/m²";
  sheet.texts.push_back({{kMargin, 46.0, kInner, 15.0}, line, 10.5, false, kGrey});
}

void add_drape(Sheet& sheet, const FabricStudy& study, const StudyPictures& pictures) {
  constexpr double kGap = 10.0;
  const double wide = kPicturesHeight * 4.0 / 3.0;
  const double narrow = kInner - 2.0 * (wide + kGap);
  const SheetBox side{kMargin, kPicturesTop, wide, kPicturesHeight};
  const SheetBox top{side.left + wide + kGap, kPicturesTop, wide, kPicturesHeight};
  const SheetBox shadow{top.left + wide + kGap, kPicturesTop, narrow, kPicturesHeight};
  sheet.images = {{side, pictures.side}, {top, pictures.top}, {shadow, pictures.shadow}};
  const auto label = [&](const SheetBox& box, const char* text) {
    sheet.texts.push_back(
        {{box.left, box.top + box.height + 1.0, box.width, 12.0}, text, 8.5, false, kGrey, true});
  };
  label(side, "from the side");
  label(top, "from above");
  label(shadow, "shadow");
  std::string words = drape_in_words(study.drape);
  words.front() = 'D';
  const std::string measured = measured_drape_in_words(study.fabric);
  sheet.texts.push_back({{kMargin, kDrapeTop, kInner, 16.0}, words, 11.0, true});
  sheet.texts.push_back(
      {{kMargin, kDrapeTop + 18.0, kInner, 14.0},
       "Simulated: " + drape_setting_in_words(study.drape) + (measured.empty() ? "" : ".  Drape " + measured),
       9.0});
}

SheetRow row_of(const FabricNumber& n, SourceList& sources) {
  const KesQuantity& q = n.definition();
  std::string place = n.section;
  std::ranges::replace(place, '.', ' ');
  const Provenance& p = n.known.provenance;
  SheetRow row{{place, std::string(q.symbol), shown_number(n.in_kes_units()), std::string(q.kes_unit),
                shown_number(n.known.value), std::string(q.si_unit),
                std::string(to_string(p.kind)) + " " + sources.number_of(p)}};
  if (!is_evidence(p)) row.colour = kAssumed;
  return row;
}

/// The numbers in two tables side by side. @return where they end
double add_numbers(Sheet& sheet, const FabricStudy& study, SourceList& sources) {
  constexpr double kGap = 18.0;
  SheetTable left;
  left.columns = {21.0, 10.0, 15.0, 20.0, 18.0, 16.0, 24.0};
  left.right = {false, false, true, false, true, false, false};
  left.head = {"", "", "KES", "", "SI", "", "kind, source"};
  left.row_height = kRowHeight;
  left.box = {kMargin, kTablesTop, 0.5 * (kInner - kGap), 0.0};
  SheetTable right = left;
  right.box.left += left.box.width + kGap;
  std::vector<SheetRow> rows;
  for (const FabricNumber& n : study.numbers) {
    if (n.known.has_value()) rows.push_back(row_of(n, sources));
  }
  const std::size_t half = (rows.size() + 1) / 2;
  left.rows.assign(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(half));
  right.rows.assign(rows.begin() + static_cast<std::ptrdiff_t>(half), rows.end());
  sheet.tables = {left, right};
  return kTablesTop + kRowHeight * static_cast<double>(half + 1);
}

void add_foot(Sheet& sheet, double top, const SourceList& sources, const std::string& version) {
  std::string text = "Orange: assumed by a rule, or a statistic over many cloths; not measured on this one.";
  for (std::size_t i = 0; i < sources.entries().size(); ++i)
    text += "   [" + std::to_string(i + 1) + "] " + sources.entries()[i];
  const double bottom = kHeight - 26.0;
  sheet.texts.push_back({{kMargin, top, kInner, bottom - top}, text, 8.0, false, kGrey});
  sheet.texts.push_back({{kMargin, kHeight - 22.0, kInner, 12.0},
                         "fuai " + version +
                             ": fabric card. Loops of the laws that are simulated, measured points where "
                             "there are any.",
                         8.0,
                         false,
                         kGrey});
}

}  // namespace

Sheet card_sheet(const FabricStudy& study, const StudyPictures& pictures, const std::string& version) {
  Sheet sheet;
  sheet.width = kWidth, sheet.height = kHeight;
  add_head(sheet, study);
  add_drape(sheet, study, pictures);
  PlotGrid grid = fabric_plot(study.fabric, study.laws);
  grid.title.clear();
  sheet.plots.push_back({{kMargin - 4.0, kPlotsTop, kInner + 8.0, kPlotsHeight}, std::move(grid)});
  SourceList sources(true);
  const double end = add_numbers(sheet, study, sources);
  add_foot(sheet, end + 8.0, sources, version);
  return sheet;
}

std::string card_html(const FabricStudy& study, const StudyPictures& pictures, const std::string& version) {
  HtmlPage page(study.fabric.name);
  page.paragraph(introduction(study.fabric));
  page.heading("Drape");
  add_drape(page, study, pictures);
  page.heading("Loops");
  add_loops(page, study);
  page.heading("Numbers");
  SourceList sources;
  page.table(number_table(study, sources));
  page.heading("What the laws were made from, and what was assumed");
  add_assumptions(page, study);
  page.heading("Sources");
  add_sources(page, sources);
  page.paragraph("Made by fuai " + version + ": fabric card.");
  return page.html();
}

}  // namespace fuai
