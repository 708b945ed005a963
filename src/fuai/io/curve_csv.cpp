// Reads and writes measured curves as CSV files (fuai-curve/1).
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/curve_csv.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/io/delimited.h"
#include "fuai/io/header_cell.h"
#include "fuai/io/number_text.h"
#include "fuai/io/text_file.h"

namespace fuai {
namespace {

/// One axis of a test: how it is written, its dimension, and the names that headers may use.
struct Axis {
  std::string_view header;  ///< canonical column header, name and unit suffix
  std::string_view unit;    ///< the canonical unit
  std::vector<std::string_view> names;
};

struct TestAxes {
  Axis strain, stress;
};

const TestAxes& axes_of(Test test) {
  static const std::array<TestAxes, 4> kAxes = {{
      {{"curvature_per_cm", "1/cm", {"curvature", "kappa", "K", "曲率"}},
       {"moment_gf_cm_per_cm",
        "gf·cm/cm",
        {"moment", "bending moment", "M", "曲げモーメント", "モーメント"}}},
      {{"angle_deg", "deg", {"angle", "shear angle", "phi", "せん断角", "せん断角度", "角度"}},
       {"force_gf_per_cm", "gf/cm", {"force", "shear force", "F", "Fs", "せん断力", "荷重", "力"}}},
      {{"strain_percent",
        "%",
        {"strain", "elongation", "extension", "epsilon", "ひずみ", "歪み", "伸び率", "伸び"}},
       {"force_gf_per_cm", "gf/cm", {"force", "tension", "load", "F", "引張力", "荷重", "張力", "力"}}},
      {{"thickness_loss_mm", "mm", {"thickness loss", "compression", "圧縮量"}},
       {"pressure_gf_per_cm2", "gf/cm2", {"pressure", "P", "圧力"}}},
  }};
  return kAxes[static_cast<std::size_t>(test)];
}

constexpr std::array kTests = {Test::kBending, Test::kShear, Test::kTensile, Test::kCompression};
constexpr std::array kDirections = {Direction::kWarp, Direction::kWeft, Direction::kBias};

// ---- first line
// ---------------------------------------------------------------------------------------------

/// Sets an option from the file; the caller's word, if any, must be the same.
template <class Value, std::size_t n>
void state(std::optional<Value>& option, const std::array<Value, n>& choices, std::string_view key,
           std::string_view word, const Where& place) {
  std::string list;
  for (const Value choice : choices) {
    list += (list.empty() ? "" : ", ") + std::string(to_string(choice));
    if (word != to_string(choice)) continue;
    if (option && *option != choice) {
      throw Error(ErrorKind::kBadInput,
                  "the file says " + std::string(key) + "=" + std::string(word) + ", but " +
                      to_string(*option) + " is asked for",
                  place, "give the right file, or correct its first line");
    }
    option = choice;
    return;
  }
  throw Error(ErrorKind::kBadInput, "unknown " + std::string(key) + " '" + std::string(word) + "'", place,
              "use one of " + list);
}

/// Reads "fuai-curve/1 test=bending direction=warp" into the options.
void read_first_line(const DelimitedText& table, CurveCsvOptions& options) {
  for (const DelimitedCell& comment : table.comments) {
    if (!comment.text.starts_with("fuai-curve/")) continue;
    const Where place = table.where(comment, "");
    std::vector<std::string> words = split_words(comment.text);
    if (words[0] != "fuai-curve/1")
      throw Error(ErrorKind::kBadInput, "unknown format '" + words[0] + "'", place,
                  "this version reads fuai-curve/1");
    for (std::size_t i = 1; i < words.size(); ++i) {
      const std::size_t equals = words[i].find('=');
      const std::string key = words[i].substr(0, equals);
      const std::string value = equals == std::string::npos ? "" : words[i].substr(equals + 1);
      if (key == "test") {
        state(options.test, kTests, key, value, place);
      } else if (key == "direction") {
        state(options.direction, kDirections, key, value, place);
      } else {
        throw Error(ErrorKind::kBadInput, "unknown word '" + words[i] + "' in the first line", place,
                    "write # fuai-curve/1 test=... direction=...");
      }
    }
    return;
  }
}

// ---- header
// -------------------------------------------------------------------------------------------------

struct Columns {
  std::size_t strain = 0, stress = 0;
  std::optional<std::size_t> branch;
  double strain_to_si = 1.0, stress_to_si = 1.0;
  std::string strain_name, stress_name;
};

/// The words of a header behind one of the axis' names; nothing when it is another column.
std::optional<std::vector<std::string>> words_behind_name(const Axis& axis, const std::string& text) {
  const std::vector<std::string> words = split_words(text);
  std::optional<std::vector<std::string>> rest;
  for (const std::string_view name : axis.names) {
    const std::vector<std::string> parts = split_words(name);
    const bool letter = name.size() == 1;  // single letters are symbols: their case counts
    const auto same = [&](const std::string& a, const std::string& b) {
      return letter ? a == b : ascii_lower(a) == ascii_lower(b);
    };
    if (parts.size() > words.size() || !std::equal(parts.begin(), parts.end(), words.begin(), same)) continue;
    const auto behind = words.begin() + static_cast<std::ptrdiff_t>(parts.size());
    if (!rest || rest->size() > static_cast<std::size_t>(words.end() - behind))
      rest = std::vector<std::string>(behind, words.end());  // the longest name counts
  }
  return rest;
}

/// The factor to SI of the unit that a header states.
double unit_factor(const DelimitedText& table, const DelimitedCell& cell, const Axis& axis,
                   const std::vector<std::string>& behind, const std::vector<std::string>& groups) {
  const std::string cure = "write it like '" + std::string(axis.header) + "' or '" +
                           std::string(axis.names[0]) + " [" + std::string(axis.unit) + "]'";
  const auto fail = [&](const std::string& what) {
    throw Error(ErrorKind::kBadInput, what, table.where(cell, cell.text), cure);
  };
  if (behind.empty() && groups.empty()) fail("the column states no unit");
  if (groups.size() + (behind.empty() ? 0 : 1) > 1) fail("the column states more than one unit");
  const std::optional<Unit> unit = behind.empty() ? try_parse_unit(groups[0]) : unit_from_words(behind);
  if (!unit) fail("the unit cannot be read");
  if (!(unit->dimension == parse_unit(axis.unit).dimension)) {
    fail("the unit does not measure this quantity (" + std::string(axis.unit) +
         " does; force and moment are those per width of the specimen, a gram of force is gf)");
  }
  return unit->factor;
}

std::optional<std::size_t> find_axis(const DelimitedText& table, const DelimitedRow& row, const Axis& axis) {
  std::optional<std::size_t> found;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (!words_behind_name(axis, split_header(row[i].text).name)) continue;
    if (found) {
      throw Error(ErrorKind::kBadInput,
                  "two columns, '" + row[*found].text + "' and '" + row[i].text + "', can be the " +
                      std::string(axis.names[0]),
                  table.where(row[i], ""), "keep one of them");
    }
    found = i;
  }
  return found;
}

double axis_factor(const DelimitedText& table, const DelimitedCell& cell, const Axis& axis) {
  const HeaderParts parts = split_header(cell.text);
  return unit_factor(table, cell, axis, *words_behind_name(axis, parts.name), parts.groups);
}

/// Finds the header row: the first that names both axes. @return its index
std::size_t find_header(const DelimitedText& table, Test test, Columns& columns) {
  const TestAxes& axes = axes_of(test);
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const DelimitedRow& row = table.rows[r];
    const auto strain = find_axis(table, row, axes.strain);
    const auto stress = strain ? find_axis(table, row, axes.stress) : std::nullopt;
    if (!strain || !stress) continue;
    columns.strain = *strain;
    columns.stress = *stress;
    columns.strain_name = row[*strain].text;
    columns.stress_name = row[*stress].text;
    columns.strain_to_si = axis_factor(table, row[*strain], axes.strain);
    columns.stress_to_si = axis_factor(table, row[*stress], axes.stress);
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (ascii_lower(row[i].text) == "branch" || ascii_lower(row[i].text) == "phase") columns.branch = i;
    }
    return r;
  }
  throw Error(ErrorKind::kBadInput,
              "no header names the columns of a " + std::string(to_string(test)) + " curve",
              table.where(table.rows[0][0], ""),
              "write the header " + std::string(axes.strain.header) + "," + std::string(axes.stress.header) +
                  ",branch");
}

// ---- samples
// ------------------------------------------------------------------------------------------------

Branch read_branch(const DelimitedText& table, const DelimitedCell& cell) {
  const std::string word = ascii_lower(cell.text);
  if (word == "load" || word == "loading") return Branch::kLoad;
  if (word == "unload" || word == "unloading") return Branch::kUnload;
  throw Error(ErrorKind::kBadInput, "'" + cell.text.substr(0, 40) + "' is no branch",
              table.where(cell, "branch"), "write load or unload");
}

/// Samples of one recording with the branch of each, where the file tells it.
struct Recording {
  std::vector<CurveSample> samples;
  std::vector<Branch> kinds;  ///< empty without a branch column
  std::vector<int> lines;
};

Recording read_samples(const DelimitedText& table, std::size_t header, const Columns& columns) {
  Recording recording;
  const std::size_t needed = std::max({columns.strain, columns.stress, columns.branch.value_or(0)}) + 1;
  for (std::size_t r = header + 1; r < table.rows.size(); ++r) {
    const DelimitedRow& row = table.rows[r];
    if (row.size() < needed) {
      throw Error(
          ErrorKind::kBadInput,
          "the line has " + std::to_string(row.size()) + " cells, the header needs " + std::to_string(needed),
          table.where(row[0], ""), "complete the line, or remove it: the file may be cut off here");
    }
    recording.samples.push_back(
        {cell_number(table, row[columns.strain], columns.strain_name) * columns.strain_to_si,
         cell_number(table, row[columns.stress], columns.stress_name) * columns.stress_to_si});
    const CurveSample& sample = recording.samples.back();
    if (const bool strain_is_bad = !std::isfinite(sample.strain);
        strain_is_bad || !std::isfinite(sample.stress)) {
      const std::size_t column = strain_is_bad ? columns.strain : columns.stress;
      throw Error(ErrorKind::kBadInput, "the value is too large",
                  table.where(row[column], strain_is_bad ? columns.strain_name : columns.stress_name),
                  "correct it, or remove the sample");
    }
    if (columns.branch) recording.kinds.push_back(read_branch(table, row[*columns.branch]));
    recording.lines.push_back(row[0].line);
  }
  return recording;
}

std::vector<CurveBranch> split_by_kind(const Recording& recording, const std::string& name) {
  std::vector<CurveBranch> branches;
  for (std::size_t i = 0; i < recording.samples.size(); ++i) {
    const bool last = i + 1 == recording.samples.size();
    if (branches.empty() || branches.back().kind != recording.kinds[i])
      branches.push_back({recording.kinds[i], {}});
    branches.back().samples.push_back(recording.samples[i]);
    const bool ends = last || recording.kinds[i + 1] != recording.kinds[i];
    if (ends && branches.back().samples.size() < 2) {
      throw Error(ErrorKind::kBadInput, "this branch has one sample only",
                  Where{name, recording.lines[i], 0, "branch"}, "a branch needs two samples or more");
    }
  }
  return branches;
}

/// Splits at the turning points of the strain; see read_curve_csv().
std::vector<CurveBranch> split_at_turns(const std::vector<CurveSample>& samples, double strain_range) {
  const double tolerance = 0.01 * strain_range;  // well above a sensor's noise, well below a cycle
  std::vector<std::size_t> turns = {0};
  std::size_t extreme = 0;
  int sense = 0;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double moved = samples[i].strain - samples[extreme].strain;
    if (sense == 0) {
      if (std::abs(moved) > tolerance) sense = moved > 0.0 ? 1 : -1;
      if (sense != 0) extreme = i;
    } else if (sense * moved >= 0.0) {
      extreme = i;
    } else if (-sense * moved > tolerance) {
      turns.push_back(extreme);
      sense = -sense;
      extreme = i;
    }
  }
  turns.push_back(samples.size() - 1);
  std::vector<CurveBranch> branches;
  const bool away = std::abs(samples[turns[1]].strain) >= std::abs(samples[0].strain);
  for (std::size_t i = 0; i + 1 < turns.size(); ++i) {
    const bool load = away == (i % 2 == 0);
    branches.push_back({load ? Branch::kLoad : Branch::kUnload,
                        {samples.begin() + static_cast<std::ptrdiff_t>(turns[i]),
                         samples.begin() + static_cast<std::ptrdiff_t>(turns[i + 1]) + 1}});
  }
  return branches;
}

/// Refuses recordings in which nothing moves, or in which the cloth pushes instead of pulling.
/// @return range of the strain
double check_recording(const std::vector<CurveSample>& samples, const std::string& name) {
  const auto fail = [&](const std::string& what, const std::string& cure) {
    throw Error(ErrorKind::kBadInput, what, Where{name, 0, 0, {}}, cure);
  };
  if (samples.size() < 3)
    fail("there are " + std::to_string(samples.size()) + " samples", "a curve needs three samples or more");
  const auto [low, high] =
      std::minmax_element(samples.begin(), samples.end(), [](auto a, auto b) { return a.strain < b.strain; });
  const double range = high->strain - low->strain;
  if (!(range > 0.0) || !std::isfinite(range))
    fail("the strain never changes", "check which column is the strain");
  // Sign of the slope by least squares, on strains scaled to 0..1 and centred.
  double mean_x = 0.0, mean_y = 0.0, covariance = 0.0;
  const double n = static_cast<double>(samples.size());
  double largest = 0.0;
  for (const CurveSample& s : samples) largest = std::max(largest, std::abs(s.stress));
  if (largest == 0.0) fail("the stress is zero everywhere", "check which column is the stress");
  for (const CurveSample& s : samples) {
    mean_x += (s.strain - low->strain) / range / n;
    mean_y += s.stress / largest / n;
  }
  for (const CurveSample& s : samples)
    covariance += ((s.strain - low->strain) / range - mean_x) * (s.stress / largest - mean_y);
  if (covariance < 0.0) {
    fail("the stress falls while the strain grows: a negative stiffness",
         "check the signs and the order of the columns");
  }
  return range;
}

}  // namespace

MeasuredCurve parse_curve_csv(std::string_view text, const std::string& name,
                              const CurveCsvOptions& options) {
  const DelimitedText table = parse_delimited(text, name);
  CurveCsvOptions stated = options;
  read_first_line(table, stated);
  if (!stated.test) {
    throw Error(ErrorKind::kBadInput, "the file does not say which test it holds", Where{name, 1, 1, {}},
                "write # fuai-curve/1 test=bending direction=warp on its first line, or name the test");
  }
  const bool has_direction = *stated.test == Test::kBending || *stated.test == Test::kTensile;
  if (has_direction && !stated.direction) {
    throw Error(ErrorKind::kBadInput, "the file does not say in which direction it was measured",
                Where{name, 1, 1, {}},
                "write direction=warp or direction=weft on its first line, or name it");
  }
  MeasuredCurve curve;
  curve.test = *stated.test;
  curve.direction = stated.direction.value_or(Direction::kWarp);
  curve.source = name;
  Columns columns;
  const std::size_t header = find_header(table, curve.test, columns);
  const Recording recording = read_samples(table, header, columns);
  const double range = check_recording(recording.samples, name);
  curve.branches = columns.branch ? split_by_kind(recording, name) : split_at_turns(recording.samples, range);
  return curve;
}

MeasuredCurve read_curve_csv(const std::string& path, const CurveCsvOptions& options) {
  return parse_curve_csv(read_text_file(path), path, options);
}

std::string format_curve_csv(const MeasuredCurve& curve) {
  const TestAxes& axes = axes_of(curve.test);
  const double strain_to_si = parse_unit(axes.strain.unit).factor;
  const double stress_to_si = parse_unit(axes.stress.unit).factor;
  std::string text = std::string("# fuai-curve/1 test=") + to_string(curve.test) +
                     " direction=" + to_string(curve.direction) + "\n" + std::string(axes.strain.header) +
                     "," + std::string(axes.stress.header) + ",branch\n";
  for (const CurveBranch& branch : curve.branches) {
    const char* kind = branch.kind == Branch::kLoad ? "load" : "unload";
    for (const CurveSample& sample : branch.samples) {
      text += number_text(sample.strain, strain_to_si) + "," + number_text(sample.stress, stress_to_si) +
              "," + kind + "\n";
    }
  }
  return text;
}

void write_curve_csv(const std::string& path, const MeasuredCurve& curve) {
  write_atomically(path, format_curve_csv(curve));
}

}  // namespace fuai
