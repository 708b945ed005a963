// Reads difference thresholds.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/threshold_file.h"

#include <algorithm>
#include <array>
#include <sstream>

#include "fuai/core/error.h"
#include "fuai/io/delimited.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/number_text.h"
#include "fuai/io/text_file.h"
#include "fuai/units/constants.h"
#include "fuai/units/parse.h"

namespace fuai {
namespace {

constexpr std::array kColumns = {"quantities", "kind",      "threshold", "unit",
                                 "what",       "condition", "remark",    "source"};
enum Column : std::size_t { kQuantities, kKind, kValue, kUnit, kWhat, kCondition, kRemark, kSource };

[[noreturn]] void refuse(const DelimitedText& table, const DelimitedCell& cell, Column column,
                         const std::string& problem, const std::string& cure) {
  throw Error(ErrorKind::kBadInput, problem, table.where(cell, kColumns[column]), cure);
}

std::vector<Kes> quantities_of(const DelimitedText& table, const DelimitedCell& cell) {
  std::vector<Kes> quantities;
  std::istringstream words(cell.text);
  for (std::string word; words >> word;) {
    const std::optional<Kes> found = find_kes(word);
    if (!found) refuse(table, cell, kQuantities, "'" + word + "' is no KES quantity", "write B, G or W");
    quantities.push_back(*found);
  }
  return quantities;
}

Unit unit_of(const DelimitedText& table, const DelimitedCell& cell) {
  try {
    return parse_unit(cell.text);
  } catch (const Error& e) {
    refuse(table, cell, kUnit, e.problem(), e.cure());
  }
}

Threshold threshold_of(const DelimitedText& table, const DelimitedRow& row) {
  if (row.size() != kColumns.size()) {
    refuse(
        table, row.front(), kQuantities,
        "the line has " + std::to_string(row.size()) + " cells instead of " + std::to_string(kColumns.size()),
        "quote cells with commas in them");
  }
  Threshold t;
  t.quantities = quantities_of(table, row[kQuantities]);
  const std::string& kind = row[kKind].text;
  if (kind != "fraction" && kind != "difference")
    refuse(table, row[kKind], kKind, "'" + kind + "' is no kind of threshold",
           "write fraction or difference");
  t.kind = kind == "fraction" ? ThresholdKind::kFraction : ThresholdKind::kDifference;
  const double number = cell_number(table, row[kValue], kColumns[kValue]);
  if (!(number > 0.0)) refuse(table, row[kValue], kValue, "a threshold is above zero", "correct the number");
  const Unit unit = unit_of(table, row[kUnit]);
  t.value = number * unit.factor;
  t.in_words = t.kind == ThresholdKind::kFraction ? brief_number(t.value / unit::kPercent) + " %"
                                                  : brief_number(number) + " " + row[kUnit].text;
  for (const Kes quantity : t.quantities) {
    const Dimension expected = t.kind == ThresholdKind::kFraction
                                   ? kDimensionless
                                   : parse_unit(kes_quantity(quantity).si_unit).dimension;
    if (unit.dimension == expected) continue;
    refuse(table, row[kUnit], kUnit,
           "'" + row[kUnit].text + "' is no unit of a " + kind + " of " +
               std::string(kes_quantity(quantity).symbol),
           "write '-' for a fraction, else a unit of the quantity");
  }
  t.what = row[kWhat].text, t.condition = row[kCondition].text;
  t.remark = row[kRemark].text, t.source = row[kSource].text;
  return t;
}

}  // namespace

std::vector<Threshold> parse_thresholds(std::string_view text, const std::string& name) {
  const DelimitedText table = parse_delimited(text, name);
  const DelimitedRow& header = table.rows.front();
  const bool known = header.size() == kColumns.size() &&
                     std::ranges::equal(header, kColumns, {}, [](const DelimitedCell& c) { return c.text; });
  if (!known) {
    refuse(table, header.front(), kQuantities, "the header is not that of a table of thresholds",
           "write quantities,kind,threshold,unit,what,condition,remark,source");
  }
  std::vector<Threshold> thresholds;
  for (std::size_t i = 1; i < table.rows.size(); ++i)
    thresholds.push_back(threshold_of(table, table.rows[i]));
  return thresholds;
}

std::vector<Threshold> bundled_thresholds() {
  const std::string path = data_folder() + "/perception/thresholds.csv";
  return parse_thresholds(read_text_file(path), path);
}

const Threshold* find_threshold(std::span<const Threshold> thresholds, Kes quantity) noexcept {
  for (const Threshold& t : thresholds) {
    if (std::ranges::find(t.quantities, quantity) != t.quantities.end()) return &t;
  }
  return nullptr;
}

}  // namespace fuai
