// Reads fabric files (fuai-fabric/1).
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/header_cell.h"
#include "fuai/io/nearest_name.h"
#include "fuai/io/number_text.h"
#include "fuai/io/text_file.h"
#include "fuai/io/toml_tree.h"

namespace fuai {
namespace {

constexpr std::string_view kFormat = "fuai-fabric/1";
constexpr const char* kTopLevel[] = {"format", "name", "composition", "structure", "note", "provenance"};

/// Walks through the tables of one file and fills a fabric.
class FabricReader {
 public:
  FabricReader(const std::string& name, const std::string& folder)
      : name_(name), folder_(folder), fields_(fabric_fields(fabric_)), curves_(fabric_curve_fields(fabric_)) {
    for (const FabricField& field : fields_) {
      known_.push_back(field.path());
      add_section(field.section);
    }
    for (const FabricCurveField& field : curves_) known_.push_back(field.path());
    for (const std::string& section : sections_) known_.push_back(section);
  }

  Fabric read(const TomlNode& root) {
    fabric_.id = fabric_id_of(name_);
    const std::string format = required_text(root, "format");
    if (format != kFormat)
      fail(*root.find("format"), "format", "the format is '" + format + "'",
           "this version reads \"" + std::string(kFormat) + "\"");
    fabric_.name = required_text(root, "name");
    if (const TomlNode* provenance = root.find("provenance")) read_provenance(*provenance);
    read_table(root, "");
    if (!fabric_.areal_mass.has_value()) {
      throw Error(ErrorKind::kBadInput, "the areal mass is missing",
                  Where{name_, 0, 0, "weight.W_mg_per_cm2"},
                  "write [weight] W_mg_per_cm2 = ...; 10 g/m² are 1 mg/cm²");
    }
    finish_provenance();
    assume_peak_loads(fabric_);
    check_consistency(fabric_, name_);
    return std::move(fabric_);
  }

 private:
  /// @param at a node or a member
  template <class Placed>
  Where place(const Placed& at, const std::string& key) const {
    return {name_, at.line, at.column, key};
  }

  [[noreturn]] void fail(const TomlNode& node, const std::string& key, const std::string& what,
                         const std::string& cure) const {
    throw Error(ErrorKind::kBadInput, what, place(node, key), cure);
  }

  /// Notes a section and the sections that it lies in.
  void add_section(const std::string& section) {
    const std::size_t dot = section.rfind('.');
    if (dot != std::string::npos) add_section(section.substr(0, dot));
    sections_.insert(section);
  }

  std::string text_of(const TomlNode& node, const std::string& key) const {
    if (!node.is_text()) fail(node, key, "a text is expected", "write it in quotes");
    return node.text;
  }

  std::string required_text(const TomlNode& root, const char* key) const {
    const TomlNode* node = root.find(key);
    std::string text = node ? text_of(*node, key) : std::string();
    if (text.empty()) {
      throw Error(
          ErrorKind::kBadInput, std::string("'") + key + "' is missing or empty", Where{name_, 0, 0, key},
          std::string("write ") + key + " = \"" +
              (key == std::string("format") ? std::string(kFormat) : "...") + "\" at the top of the file");
    }
    return text;
  }

  // ---- sections, numbers, curves
  // ----------------------------------------------------------------------------

  static std::string path_of(const std::string& prefix, const std::string& key) {
    return prefix.empty() ? key : prefix + "." + key;
  }

  void read_table(const TomlNode& table, const std::string& prefix) {
    for (const TomlMember& member : table.members) {
      const TomlNode& node = member.value;
      const std::string path = path_of(prefix, member.key);
      if (prefix.empty() && read_top_level(member.key, node)) continue;
      if (sections_.contains(path)) {
        if (!node.is_table())
          fail(node, path, "a table is expected", "write [" + path + "] on a line of its own");
        read_table(node, path);
      } else if (!read_number(path, node) && !read_curve(path, node)) {
        fail_unknown(member, path, prefix);
      }
    }
  }

  bool read_top_level(const std::string& key, const TomlNode& node) {
    if (key == "composition") fabric_.composition = text_of(node, key);
    if (key == "note") fabric_.note = text_of(node, key);
    if (key == "structure") fabric_.weave.structure = structure_of(node);
    return std::ranges::find(kTopLevel, key) != std::end(kTopLevel);
  }

  WeaveStructure structure_of(const TomlNode& node) const {
    const std::string word = text_of(node, "structure");
    for (int i = 0; i < kWeaveStructureCount; ++i)
      if (word == to_string(static_cast<WeaveStructure>(i))) return static_cast<WeaveStructure>(i);
    fail(node, "structure", "unknown structure '" + word.substr(0, 40) + "'",
         "write plain, twill, satin or knit, the one that looks most like it");
  }

  bool read_number(const std::string& path, const TomlNode& node) {
    const auto field =
        std::find_if(fields_.begin(), fields_.end(), [&](const auto& f) { return f.path() == path; });
    if (field == fields_.end()) return false;
    if (!node.is_number()) {
      fail(node, path, node.is_text() ? "a number is expected, not a text" : "a number is expected",
           node.is_text() ? "remove the quotes" : "write " + field->key + " = 1.0");
    }
    const double number = node.number;
    check_field(*field, number, place(node, path), fabric_.warnings);
    *field->value = {number * field->to_si, provenance_of(path)};
    return true;
  }

  bool read_curve(const std::string& path, const TomlNode& node) {
    const auto field =
        std::find_if(curves_.begin(), curves_.end(), [&](const auto& f) { return f.path() == path; });
    if (field == curves_.end()) return false;
    namespace fs = std::filesystem;
    const std::string file = text_of(node, path);
    const fs::path relative(file);
    const bool leaves =
        std::any_of(relative.begin(), relative.end(), [](const fs::path& part) { return part == ".."; });
    if (file.empty() || file.find('\0') != std::string::npos || relative.is_absolute() || leaves) {
      fail(node, path, "'" + file.substr(0, 80) + "' is no file beside or below the fabric file",
           "put the curve file into the same folder and write its name");
    }
    const std::string full = (fs::path(folder_) / relative).string();
    std::error_code code;
    if (!fs::exists(full, code))
      fail(node, path, "the curve file '" + full + "' does not exist", "put it there, or correct the name");
    // Shear is between warp and weft; its curve says how it was measured (a bias strip, for one).
    CurveCsvOptions expected{field->test, field->direction};
    if (field->test == Test::kShear) expected.direction.reset();
    const MeasuredCurve curve = read_curve_csv(full, expected);
    for (const std::string& warning : curve_warnings(curve)) fabric_.warnings.push_back(warning);
    *field->curve = KnownCurve{curve, provenance_of(path)};
    return true;
  }

  /// The cure of an unknown key: the key that was meant, with the number converted when its unit is another
  /// one.
  std::string meant_key(const std::string& path, const std::string& section, const TomlNode& node) const {
    std::vector<std::string> words = split_words(path.substr(section.empty() ? 0 : section.size() + 1));
    for (const FabricField& field : fields_) {
      if (words.empty() || field.section != section || !field.kes ||
          kes_quantity(*field.kes).symbol != words[0])
        continue;
      const std::optional<Unit> unit = unit_from_words({words.begin() + 1, words.end()});
      const bool converts =
          words.size() > 1 && unit && node.is_number() && unit->dimension == parse_unit(field.unit).dimension;
      return "write " + field.key +
             (converts ? " = " + brief_number(node.number * unit->factor / field.to_si) : "");
    }
    std::vector<std::string> candidates = known_;
    candidates.insert(candidates.end(), std::begin(kTopLevel), std::end(kTopLevel));
    const std::vector<std::string> nearest = nearest_names(path, candidates);
    if (!nearest.empty()) return "the nearest known key is " + nearest.front();
    return "remove it; the fabric file format lists the known keys";
  }

  [[noreturn]] void fail_unknown(const TomlMember& member, const std::string& path,
                                 const std::string& section) const {
    throw Error(ErrorKind::kBadInput, member.value.is_table() ? "unknown section" : "unknown key",
                place(member, path), meant_key(path, section, member.value));
  }

  // ---- provenance
  // -------------------------------------------------------------------------------------------

  struct Entry {
    Provenance provenance;
    Where where;
    bool used = false;
  };

  ProvenanceKind kind_of(const TomlNode& node, const std::string& key) const {
    constexpr ProvenanceKind kKinds[] = {ProvenanceKind::kMeasured, ProvenanceKind::kComputed,
                                         ProvenanceKind::kFitted, ProvenanceKind::kStatistic,
                                         ProvenanceKind::kAssumed};
    const std::string word = text_of(node, key);
    for (const ProvenanceKind kind : kKinds) {
      if (word == to_string(kind)) return kind;
    }
    fail(node, key, "unknown kind '" + word.substr(0, 40) + "'",
         "write measured, computed, fitted, statistic or assumed");
  }

  void read_provenance(const TomlNode& node) {
    if (!node.is_table())
      fail(node, "provenance", "a table is expected", "write [provenance] on a line of its own");
    for (const TomlMember& member : node.members) {
      const TomlNode& value = member.value;
      const std::string& path = member.key;
      const std::string shown = "provenance.\"" + path + "\"";
      if (std::find(known_.begin(), known_.end(), path) == known_.end()) {
        const std::vector<std::string> nearest = nearest_names(path, known_);
        throw Error(ErrorKind::kBadInput, "this names no block or key of a fabric file", place(member, shown),
                    nearest.empty() ? "write a block such as \"bending\""
                                    : "the nearest is \"" + nearest.front() + "\"");
      }
      if (!value.is_table())
        fail(value, shown, "a table is expected", R"(write { kind = "measured", source = "..." })");
      Entry entry;
      entry.where = place(member, shown);
      bool has_kind = false;
      for (const TomlMember& part : value.members) {
        const std::string part_key = shown + "." + part.key;
        if (part.key == "kind") {
          entry.provenance.kind = kind_of(part.value, part_key);
          has_kind = true;
        } else if (part.key == "source") {
          entry.provenance.source = text_of(part.value, part_key);
        } else if (part.key == "quality") {
          entry.provenance.quality = text_of(part.value, part_key);
        } else {
          throw Error(ErrorKind::kBadInput, "unknown key", place(part, part_key),
                      "write kind, source and quality; a dotted name stands in quotes: \"" + path + "." +
                          part.key + "\" = { ... }");
        }
      }
      if (!has_kind || entry.provenance.source.empty())
        fail(value, shown, "kind or source is missing", R"(write { kind = "measured", source = "..." })");
      provenance_[path] = entry;
    }
  }

  /// The most specific entry for a key; without one the number counts as measured and is reported.
  Provenance provenance_of(const std::string& path) {
    for (std::string at = path;; at.resize(at.rfind('.'))) {
      if (const auto found = provenance_.find(at); found != provenance_.end()) {
        found->second.used = true;
        return found->second.provenance;
      }
      if (at.find('.') == std::string::npos) break;
    }
    without_provenance_.push_back(path);
    const std::string file = std::filesystem::path(name_).filename().string();
    return {ProvenanceKind::kMeasured, "stated in " + file + ", origin not given", ""};
  }

  void finish_provenance() {
    if (!without_provenance_.empty()) {
      std::string list;
      for (const std::string& path : without_provenance_) list += (list.empty() ? "" : ", ") + path;
      fabric_.warnings.push_back(name_ + ": no [provenance] for " + list +
                                 ": taken as measured, origin not given");
    }
    for (const auto& [path, entry] : provenance_) {
      if (!entry.used)
        fabric_.warnings.push_back(to_string(entry.where) + "the file holds nothing that this describes");
    }
  }

  const std::string& name_;
  const std::string& folder_;
  Fabric fabric_;
  std::vector<FabricField> fields_;
  std::vector<FabricCurveField> curves_;
  std::set<std::string> sections_;
  std::vector<std::string> known_;  ///< every path that provenance may name
  std::map<std::string, Entry> provenance_;
  std::vector<std::string> without_provenance_;
};

}  // namespace

Fabric parse_fabric(std::string_view text, const std::string& name, const std::string& folder) {
  return FabricReader(name, folder).read(parse_toml(text, name));
}

Fabric read_fabric_file(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  return parse_fabric(read_text_file(path, kLargestFabricFile), path, folder.empty() ? "." : folder.string());
}

}  // namespace fuai
