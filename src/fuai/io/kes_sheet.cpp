// Reads sheets of KES parameters, one fabric a row or one fabric a column.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/kes_sheet.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/io/delimited.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/kes_header.h"
#include "fuai/io/text_file.h"

namespace fuai {
namespace {

/// How far into the sheet a header row or column is looked for.
constexpr std::size_t kHeaderRows = 20, kHeaderColumns = 4;

/// One column of the (possibly transposed) sheet that is read.
struct Column {
  std::size_t index = 0;
  DelimitedCell cell;  ///< its header
  SheetHeader header;
};

/// A sheet with one fabric a row, its header row found.
struct Sheet {
  DelimitedText table;
  std::size_t header_row = 0;
  std::size_t first_row = 0;  ///< of the fabrics
  std::vector<Column> columns;
  std::vector<std::string> warnings;
};

/// The numbers that make up one field of a fabric: usually one column, two where directions are averaged.
using Targets = std::map<std::string, std::vector<const Column*>>;

// ---- orientation and headers
// --------------------------------------------------------------------------------

bool is_quantity(const DelimitedCell& cell) {
  try {
    const SheetRole role = read_sheet_header(cell.text).role;
    return role == SheetRole::kQuantity || role == SheetRole::kNodeCount;
  } catch (const Error&) {
    return true;  // it means to be one; the message comes when the header is read
  }
}

/// Swaps rows and columns; missing cells become empty ones.
void transpose(DelimitedText& table) {
  std::vector<DelimitedRow> turned;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const DelimitedRow& row = table.rows[r];
    if (turned.size() < row.size()) turned.resize(row.size());
    for (std::size_t c = 0; c < turned.size(); ++c) {
      turned[c].resize(r + 1, DelimitedCell{{}, row[0].line, 0});
      if (c < row.size()) turned[c][r] = row[c];
    }
  }
  table.rows = std::move(turned);
}

/// Finds the line with most quantities among the first rows and columns, and turns the sheet if it is a
/// column.
void find_header(Sheet& sheet) {
  DelimitedText& table = sheet.table;
  std::vector<int> in_row(std::min(table.rows.size(), kHeaderRows)), in_column(kHeaderColumns);
  const bool may_turn = table.rows.size() <= static_cast<std::size_t>(kMostCells);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    for (std::size_t c = 0; c < table.rows[r].size(); ++c) {
      const bool row_counts = r < in_row.size(), column_counts = may_turn && c < in_column.size();
      if ((!row_counts && !column_counts) || !is_quantity(table.rows[r][c])) continue;
      if (row_counts) ++in_row[r];
      if (column_counts) ++in_column[c];
    }
    if (!may_turn && r + 1 >= in_row.size()) break;
  }
  const auto row = std::max_element(in_row.begin(), in_row.end());
  const auto column = std::max_element(in_column.begin(), in_column.end());
  if (*row == 0 && *column == 0) {
    throw Error(ErrorKind::kBadInput, "no header names a KES quantity", table.where(table.rows[0][0], ""),
                "name the columns B1, B2, 2HB1, G, WT1, W [mg/cm2], ... or 曲げ剛性(たて), ...");
  }
  if (*row == *column) {
    throw Error(ErrorKind::kBadInput, "it is unclear whether the fabrics stand in rows or in columns",
                table.where(table.rows[0][0], ""), "name at least two quantities in one header row");
  }
  const bool turn = *column > *row;
  sheet.header_row = static_cast<std::size_t>(turn ? column - in_column.begin() : row - in_row.begin());
  if (turn) transpose(table);
}

void read_headers(Sheet& sheet) {
  const DelimitedRow& row = sheet.table.rows[sheet.header_row];
  std::string unread;
  for (std::size_t i = 0; i < row.size(); ++i) {
    try {
      const SheetHeader header = read_sheet_header(row[i].text);
      if (header.role != SheetRole::kUnread) sheet.columns.push_back({i, row[i], header});
      if (header.role == SheetRole::kUnread && !row[i].text.empty())
        unread += (unread.empty() ? "'" : ", '") + row[i].text + "'";
    } catch (const Error& e) {
      throw Error(ErrorKind::kBadInput, e.problem(), sheet.table.where(row[i], ""), e.cure());
    }
  }
  if (!unread.empty()) sheet.warnings.push_back(sheet.table.name + ": not read: " + unread);
}

/// Without a column of names, a first column that no header claims and that holds text is taken for one.
void find_names(Sheet& sheet) {
  const bool named = std::any_of(sheet.columns.begin(), sheet.columns.end(), [](const Column& column) {
    return column.header.role == SheetRole::kName || column.header.role == SheetRole::kCode ||
           column.index == 0;
  });
  if (named || sheet.first_row >= sheet.table.rows.size()) return;
  const DelimitedCell& first = sheet.table.rows[sheet.first_row][0];
  if (first.text.empty() || is_number(sheet.table, first)) return;
  const DelimitedCell& header = sheet.table.rows[sheet.header_row][0];
  SheetHeader role;
  role.role = SheetRole::kName;
  sheet.columns.push_back({0, header, role});
  sheet.warnings.push_back(sheet.table.name + ": the first entries ('" + header.text +
                           "') are taken for the fabrics' names");
}

/// Takes the row below the header as units when nothing in it is a number and every quantity's cell is a
/// unit.
void read_units_row(Sheet& sheet) {
  sheet.first_row = sheet.header_row + 1;
  if (sheet.first_row >= sheet.table.rows.size()) return;
  const DelimitedRow& row = sheet.table.rows[sheet.first_row];
  int units = 0;
  for (const Column& column : sheet.columns) {
    if (column.header.role != SheetRole::kQuantity || column.index >= row.size()) continue;
    const DelimitedCell& cell = row[column.index];
    if (cell.text.empty() || cell.text == "-") continue;
    if (is_number(sheet.table, cell) || !read_sheet_unit(cell.text)) return;
    ++units;
  }
  if (units == 0) return;
  ++sheet.first_row;
  for (Column& column : sheet.columns) {
    if (column.header.role != SheetRole::kQuantity || column.index >= row.size()) continue;
    const std::optional<Unit> unit = read_sheet_unit(row[column.index].text);
    if (unit && column.header.unit) {
      throw Error(ErrorKind::kBadInput, "the unit stands in the header and below it",
                  sheet.table.where(row[column.index], column.cell.text), "keep one of them");
    }
    if (unit) column.header.unit = unit;
  }
}

/// Settles the unit of each quantity: the stated one must measure the same thing, a missing one is the KES
/// unit.
void settle_units(Sheet& sheet) {
  std::string assumed;
  for (Column& column : sheet.columns) {
    if (column.header.role != SheetRole::kQuantity) continue;
    const KesQuantity& q = kes_quantity(column.header.quantity);
    const Unit kes = parse_unit(q.kes_unit);
    constexpr double kRounding = 1e-14;  // spellings of one unit differ in the last places of their factor
    if (!column.header.unit) {
      if (q.kes_unit != "-")
        assumed += (assumed.empty() ? "" : ", ") + column.cell.text + " in " + std::string(q.kes_unit);
      column.header.unit = Unit{q.to_si, kes.dimension};
    } else if (!(column.header.unit->dimension == kes.dimension)) {
      throw Error(
          ErrorKind::kBadInput, "the unit does not measure " + std::string(q.symbol),
          sheet.table.where(column.cell, column.cell.text),
          "write it in " + std::string(q.kes_unit) + " or a unit of the same kind; a gram of force is gf");
    } else if (std::abs(column.header.unit->factor / q.to_si - 1.0) < kRounding) {
      column.header.unit->factor = q.to_si;
    }
  }
  if (!assumed.empty())
    sheet.warnings.push_back(sheet.table.name + ": no unit stated; taken as KES units: " + assumed);
}

// ---- which column goes where
// --------------------------------------------------------------------------------

/// The field paths that a column fills.
std::vector<std::string> paths_of(Sheet& sheet, const Column& column) {
  if (column.header.role == SheetRole::kNodeCount) return {"drape.node_count"};
  const KesQuantity& q = kes_quantity(column.header.quantity);
  const std::string block(q.block), key(q.key);
  const auto direction = column.header.direction;
  const std::string note = sheet.table.name + ": column '" + column.cell.text + "' ";
  if (column.header.numbered)
    sheet.warnings.push_back(note + "is read as the " + to_string(*direction) +
                             " (1 is the warp, 2 the weft in Kato's usage)");
  const auto fail = [&](const std::string& what, const std::string& cure) {
    throw Error(ErrorKind::kBadInput, what, sheet.table.where(column.cell, column.cell.text), cure);
  };
  if (has_direction(q.id) && direction) {
    if (block == "tensile" && *direction == Direction::kBias)
      fail("the fabric model keeps no tensile test on the bias", "remove the column");
    return {block + "." + to_string(*direction) + "." + key};
  }
  if (has_direction(q.id)) {
    sheet.warnings.push_back(note + "states no direction and is taken for warp and weft");
    return {block + ".warp." + key, block + ".weft." + key};
  }
  const bool averaged = block == "shear" || block == "surface";
  if (direction && (!averaged || *direction == Direction::kBias))
    fail(std::string(q.symbol) + " has no such direction", "remove the direction from the header");
  return {block + "." + key};
}

[[noreturn]] void fail_double(const Sheet& sheet, const Column& first, const Column& second) {
  throw Error(ErrorKind::kBadInput,
              "'" + first.cell.text + "' and '" + second.cell.text + "' are both read as the same number",
              sheet.table.where(second.cell, second.cell.text), "remove one, or state warp and weft");
}

/// Reduces the columns of one field to one, or to warp and weft of a quantity that is averaged.
void settle_field(Sheet& sheet, std::vector<const Column*>& columns) {
  if (columns.size() > 1) {
    // A mean beside its parts is dropped.
    const auto means =
        std::partition(columns.begin(), columns.end(), [](const Column* c) { return !c->header.is_mean; });
    for (auto mean = means; mean != columns.end() && means != columns.begin(); ++mean)
      sheet.warnings.push_back(sheet.table.name + ": column '" + (*mean)->cell.text +
                               "' is not read: warp and weft stand beside it");
    if (means != columns.begin()) columns.erase(means, columns.end());
  }
  std::set<std::optional<Direction>> directions;
  for (const Column* column : columns) {
    const bool fresh = directions.insert(column->header.direction).second;
    if (!fresh || (columns.size() > 1 && !column->header.direction))
      fail_double(sheet, *columns.front(), *column);
  }
  if (columns.size() > 1 && columns.front()->header.role == SheetRole::kQuantity &&
      has_direction(columns.front()->header.quantity))
    fail_double(sheet, *columns[0], *columns[1]);
  if (columns.size() > 1)
    sheet.warnings.push_back(sheet.table.name + ": '" + columns[0]->cell.text + "' and '" +
                             columns[1]->cell.text + "' are averaged");
}

Targets make_targets(Sheet& sheet) {
  Targets targets;
  for (const Column& column : sheet.columns) {
    if (column.header.role != SheetRole::kQuantity && column.header.role != SheetRole::kNodeCount) continue;
    for (const std::string& path : paths_of(sheet, column)) targets[path].push_back(&column);
  }
  for (auto& [path, columns] : targets) settle_field(sheet, columns);
  return targets;
}

// ---- fabrics
// ------------------------------------------------------------------------------------------------

bool is_missing(const DelimitedRow& row, std::size_t index) {
  if (index >= row.size()) return true;
  const std::string& text = row[index].text;
  return text.empty() || text == "-" || text == "NA" || text == "N/A" || text == "n/a";
}

std::string text_at(const Sheet& sheet, const DelimitedRow& row, SheetRole role) {
  for (const Column& column : sheet.columns) {
    if (column.header.role == role && column.index < row.size() && !row[column.index].text.empty())
      return row[column.index].text;
  }
  return {};
}

/// "wool-tropical" of "Wool  Tropical!": ASCII letters and digits, words joined by '-'.
std::string slug(const std::string& name) {
  std::string result;
  for (const char c : name) {
    const char lower = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const bool keeps = (lower >= 'a' && lower <= 'z') || (lower >= '0' && lower <= '9');
    if (keeps) result += lower;
    if (!keeps && !result.empty() && result.back() != '-') result += '-';
  }
  while (!result.empty() && result.back() == '-') result.pop_back();
  return result;
}

void read_field(const Sheet& sheet, const DelimitedRow& row, const FabricField& field,
                const std::vector<const Column*>& columns, const std::string& source, Fabric& fabric) {
  double sum = 0.0;
  int count = 0;
  for (const Column* column : columns) {
    if (is_missing(row, column->index)) continue;
    const DelimitedCell& cell = row[column->index];
    const double to_si = column->header.unit ? column->header.unit->factor : field.to_si;
    const double si = cell_number(sheet.table, cell, column->cell.text) * to_si;
    check_field(field, si / field.to_si, sheet.table.where(cell, column->cell.text), fabric.warnings);
    sum += si;
    ++count;
  }
  if (count == 0) return;
  const bool averaged = count > 1;
  *field.value = {averaged ? sum / count : sum,
                  {averaged ? ProvenanceKind::kComputed : ProvenanceKind::kMeasured,
                   averaged ? "mean of warp and weft, " + source : source, ""}};
}

Fabric read_fabric(const Sheet& sheet, const Targets& targets, const DelimitedRow& row, std::size_t number) {
  Fabric fabric;
  fabric.warnings = sheet.warnings;
  const std::filesystem::path file(sheet.table.name);
  fabric.name = text_at(sheet, row, SheetRole::kName);
  if (fabric.name.empty()) fabric.name = text_at(sheet, row, SheetRole::kCode);
  if (fabric.name.empty()) {
    fabric.name = file.stem().string() + " " + std::to_string(number);
    fabric.warnings.push_back(sheet.table.name + ": no column holds the fabric's name; called '" +
                              fabric.name + "'");
  }
  fabric.id = slug(fabric.name);
  if (fabric.id.empty()) fabric.id = "fabric-" + std::to_string(number);
  fabric.composition = text_at(sheet, row, SheetRole::kComposition);
  const std::string source = "KES sheet " + file.filename().string() + ", " + fabric.name;
  for (const FabricField& field : fabric_fields(fabric)) {
    if (const auto columns = targets.find(field.path()); columns != targets.end())
      read_field(sheet, row, field, columns->second, source, fabric);
  }
  if (!fabric.areal_mass.has_value()) {
    throw Error(ErrorKind::kBadInput, "'" + fabric.name + "' has no areal mass",
                sheet.table.where(row[0], "W"), "add a column W [mg/cm2]");
  }
  assume_peak_loads(fabric);
  check_consistency(fabric, sheet.table.name + ": " + fabric.name);
  return fabric;
}

}  // namespace

std::vector<Fabric> parse_kes_sheet(std::string_view text, const std::string& name) {
  Sheet sheet;
  sheet.table = parse_delimited(text, name);
  find_header(sheet);
  read_headers(sheet);
  read_units_row(sheet);
  find_names(sheet);
  settle_units(sheet);
  const Targets targets = make_targets(sheet);

  std::vector<Fabric> fabrics;
  std::set<std::string> ids;
  for (std::size_t r = sheet.first_row; r < sheet.table.rows.size(); ++r) {
    const DelimitedRow& row = sheet.table.rows[r];
    const bool empty = std::all_of(targets.begin(), targets.end(), [&](const auto& target) {
      return std::all_of(target.second.begin(), target.second.end(),
                         [&](const Column* c) { return is_missing(row, c->index); });
    });
    if (empty) continue;
    if (fabrics.size() >= static_cast<std::size_t>(kMostFabrics)) {
      throw Error(ErrorKind::kBadInput, "there are more than " + std::to_string(kMostFabrics) + " fabrics",
                  sheet.table.where(row[0], ""), "split the sheet; a curve is no sheet");
    }
    Fabric fabric = read_fabric(sheet, targets, row, fabrics.size() + 1);
    const std::string id = fabric.id;
    for (int copy = 2; !ids.insert(fabric.id).second; ++copy) fabric.id = id + "-" + std::to_string(copy);
    fabrics.push_back(std::move(fabric));
  }
  if (fabrics.empty()) {
    throw Error(ErrorKind::kBadInput, "the sheet holds no fabric below its header", Where{name, 0, 0, {}},
                "check that the file was exported completely");
  }
  return fabrics;
}

std::vector<Fabric> read_kes_sheet(const std::string& path) {
  return parse_kes_sheet(read_text_file(path), path);
}

}  // namespace fuai
