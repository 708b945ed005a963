// Writes about several fabrics.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/comparison_page.h"

#include <algorithm>
#include <cmath>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/fabric/scalar_laws.h"
#include "fuai/io/number_text.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

std::string row_head(const FabricNumber& n) {
  std::string section = n.section;
  std::ranges::replace(section, '.', ' ');
  return section + " " + std::string(n.definition().symbol);
}

std::string difference_text(double change, double jnd) {
  if (std::isnan(change) && std::isnan(jnd)) return "–";
  std::string text;
  if (!std::isnan(change)) text = signed_number(100.0 * change, 0) + "\u00a0%";
  if (!std::isnan(jnd)) text += (text.empty() ? "" : "; ") + signed_number(jnd, 1) + "\u00a0jnd";
  return text;
}

/// The curve of the law out of a fabric's own plot: the last line whose label begins so.
Series law_series(const Plot& plot, const std::string& beginning) {
  for (auto series = plot.series.rbegin(); series != plot.series.rend(); ++series) {
    if (series->style == SeriesStyle::kLine && series->label.starts_with(beginning)) return *series;
  }
  return {};
}

bool is_assumed(const FabricLaws& laws, const std::string& law) {
  return std::ranges::any_of(laws.reports,
                             [&](const LawReport& r) { return r.law == law && r.origin == "assumed"; });
}

/// Cuts a plot to +-range: a bias strip goes far beyond the range of the instrument.
void show_within(double range, Plot& plot) {
  constexpr double kMargin = 1.08;
  double most = 0.0;
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < series.x.size(); ++i)
      if (std::abs(series.x[i]) <= range && std::isfinite(series.y[i]))
        most = std::max(most, std::abs(series.y[i]));
  }
  if (!(most > 0.0)) return;
  plot.x_range = Range{-kMargin * range, kMargin * range};
  plot.y_range = Range{-kMargin * most, kMargin * most};
}

}  // namespace

std::string signed_number(double value, int decimals) {
  std::string size = fixed_number(std::abs(value), decimals);
  if (size.find_first_not_of("0.") == std::string::npos) return size;  // nothing of it shows
  return (value < 0.0 ? "−" : "+") + size;
}

HtmlTable value_table(const FabricComparison& comparison) {
  HtmlTable table;
  table.header = {"", "unit"};
  for (const Fabric& fabric : comparison.fabrics) table.header.push_back(short_name(fabric));
  for (const ComparedNumber& number : comparison.numbers) {
    std::vector<std::string> row{row_head(number.first()), std::string(number.first().definition().kes_unit)};
    for (const FabricNumber& n : number.each) {
      row.push_back(n.known.has_value()
                        ? shown_number(n.in_kes_units()) + " " + to_string(n.known.provenance.kind)
                        : "–");
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

HtmlTable difference_table(const FabricComparison& comparison) {
  HtmlTable table;
  table.header = {""};
  for (std::size_t i = 1; i < comparison.fabrics.size(); ++i)
    table.header.push_back(short_name(comparison.fabrics[i]));
  table.header.emplace_back("threshold");
  for (const ComparedNumber& number : comparison.numbers) {
    std::vector<std::string> row{row_head(number.first())};
    for (std::size_t i = 1; i < number.each.size(); ++i)
      row.push_back(difference_text(number.change[i], number.jnd[i]));
    row.push_back(number.threshold ? number.threshold->in_words : "–");
    const auto empty = [](const std::string& cell) { return cell == "–"; };
    if (!std::all_of(row.begin() + 1, row.end() - 1, empty)) table.rows.push_back(std::move(row));
  }
  return table;
}

std::vector<std::string> threshold_sentences(const FabricComparison& comparison) {
  std::vector<std::string> sentences;
  for (const Threshold& t : comparison.thresholds) {
    std::string text = t.in_words + ": " + t.what + " (" + t.condition + ")";
    if (!t.quantities.empty()) {
      text += ", used for ";
      for (const Kes quantity : t.quantities) {
        text += (text.ends_with("for ") ? "" : ", ") + std::string(kes_quantity(quantity).symbol);
      }
    }
    sentences.push_back(text + "; " + t.remark + ". " + t.source + ".");
  }
  return sentences;
}

PlotGrid comparison_plots(std::span<const FabricStudy* const> studies) {
  PlotGrid grid;
  grid.columns = 2;
  const auto add = [&](const std::string& title, const std::string& law, const std::string& beginning,
                       auto plot_of) {
    Plot together;
    for (std::size_t i = 0; i < studies.size(); ++i) {
      const Plot own = plot_of(*studies[i]);
      together.x_label = own.x_label, together.y_label = own.y_label;
      Series series = law_series(own, beginning);
      series.label = short_name(studies[i]->fabric) + (is_assumed(studies[i]->laws, law) ? ", assumed" : "");
      series.colour = static_cast<int>(i);
      series.arrows = false;
      together.series.push_back(std::move(series));
    }
    together.title = title;
    grid.plots.push_back(std::move(together));
  };
  for (const Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const std::string name = to_string(direction);
    add("Bending, " + name, "bending." + name, name,
        [](const FabricStudy& s) { return bending_plot(s.fabric, s.laws); });
  }
  for (const Direction direction : {Direction::kWarp, Direction::kWeft}) {
    const std::string name = to_string(direction);
    add("Tension, " + name, "tensile." + name, {},
        [&](const FabricStudy& s) { return tensile_plot(s.fabric, s.laws, direction); });
  }
  add("Shear", "shear", {}, [](const FabricStudy& s) { return shear_plot(s.fabric, s.laws); });
  show_within(kes_shear_range() / unit::kDegree, grid.plots.back());
  return grid;
}

}  // namespace fuai
