// Writes fabric files (fuai-fabric/1).
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/number_text.h"
#include "fuai/io/text_file.h"
#include "fuai/io/toml_tree.h"

namespace fuai {
namespace {

std::string curve_file_name(const std::string& stem, const FabricCurveField& field) {
  return stem + "." + field.section + ".csv";
}

/// A tensile peak load that the reader would put there by itself.
bool is_default(const FabricField& field) {
  const Known standard = standard_peak_load();
  return field.key == "peak_load_gf_per_cm" && field.value->value == standard.value &&
         field.value->provenance.kind == standard.provenance.kind &&
         field.value->provenance.source == standard.provenance.source;
}

/// The path of everything that the file holds, with its provenance; the format demands a source.
using Origins = std::vector<std::pair<std::string, Provenance>>;

bool same(const Provenance& a, const Provenance& b) {
  return a.kind == b.kind && a.source == b.source && a.quality == b.quality;
}

std::string provenance_line(const std::string& path, const Provenance& provenance) {
  const std::string source = provenance.source.empty() ? "origin not given" : provenance.source;
  return toml_string(path) + " = { kind = \"" + to_string(provenance.kind) +
         "\", source = " + toml_string(source) +
         (provenance.quality.empty() ? "" : ", quality = " + toml_string(provenance.quality)) + " }\n";
}

/// One entry for a block in which everything has the same origin, else one entry a key.
std::string format_provenance(const Origins& origins) {
  std::string text = "\n[provenance]\n";
  for (auto begin = origins.begin(); begin != origins.end();) {
    const std::string block = begin->first.substr(0, begin->first.find('.'));
    const auto end = std::find_if(begin, origins.end(), [&](const auto& origin) {
      return origin.first.substr(0, origin.first.find('.')) != block;
    });
    const bool uniform =
        std::all_of(begin, end, [&](const auto& o) { return same(o.second, begin->second); });
    if (uniform) text += provenance_line(block, begin->second);
    for (auto origin = begin; !uniform && origin != end; ++origin)
      text += provenance_line(origin->first, origin->second);
    begin = end;
  }
  return text;
}

std::string format_section(const std::string& section, const std::vector<FabricField>& fields,
                           const std::vector<FabricCurveField>& curves, const std::string& stem,
                           Origins& origins) {
  std::string text;
  for (const FabricField& field : fields) {
    if (field.section != section || !field.value->has_value() || is_default(field)) continue;
    std::vector<std::string> ignored;  // ranges are the reader's business
    check_field(field, field.value->value / field.to_si, Where{"", 0, 0, field.path()}, ignored);
    text += field.key + " = " + number_text(field.value->value, field.to_si) + "\n";
    origins.emplace_back(field.path(), field.value->provenance);
  }
  for (const FabricCurveField& field : curves) {
    if (field.section != section || !field.curve->has_value()) continue;
    text += "curve = " + toml_string(curve_file_name(stem, field)) + "\n";
    origins.emplace_back(field.path(), (*field.curve)->provenance);
  }
  return text.empty() ? text : "\n[" + section + "]\n" + text;
}

}  // namespace

std::string fabric_id_of(const std::string& path) {
  std::string id = std::filesystem::path(path).filename().string();
  for (const std::string_view ending : {".toml", ".fabric"}) {
    if (id.size() > ending.size() && id.ends_with(ending)) id.resize(id.size() - ending.size());
  }
  return id;
}

std::string format_fabric(const Fabric& fabric, const std::string& stem) {
  Fabric copy = fabric;  // the field list points into a fabric that it may change
  if (fabric.name.empty()) throw Error(ErrorKind::kBadInput, "the fabric has no name", {}, "give it one");
  if (!fabric.areal_mass.has_value())
    throw Error(ErrorKind::kBadInput, "the fabric has no areal mass", Where{"", 0, 0, "weight.W_mg_per_cm2"},
                "state it");
  const std::vector<FabricField> fields = fabric_fields(copy);
  const std::vector<FabricCurveField> curves = fabric_curve_fields(copy);
  const std::string curve_stem = stem.empty() ? (fabric.id.empty() ? "fabric" : fabric.id) : stem;

  std::string text = "format = \"fuai-fabric/1\"\nname = " + toml_string(fabric.name) + "\n";
  if (!fabric.composition.empty()) text += "composition = " + toml_string(fabric.composition) + "\n";
  if (fabric.weave.structure) text += "structure = " + toml_string(to_string(*fabric.weave.structure)) + "\n";
  if (!fabric.note.empty()) text += "note = " + toml_string(fabric.note) + "\n";
  Origins origins;
  std::string section;
  for (const FabricField& field : fields) {
    if (field.section == section) continue;
    section = field.section;
    text += format_section(section, fields, curves, curve_stem, origins);
  }
  return text + format_provenance(origins);
}

std::vector<std::string> fabric_file_paths(const std::string& path, const Fabric& fabric) {
  Fabric copy = fabric;
  std::vector<std::string> paths;
  for (const FabricCurveField& field : fabric_curve_fields(copy)) {
    if (!field.curve->has_value()) continue;
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    paths.push_back((folder / curve_file_name(fabric_id_of(path), field)).string());
  }
  paths.push_back(path);
  return paths;
}

void write_fabric_file(const std::string& path, const Fabric& fabric) {
  const std::vector<std::string> paths = fabric_file_paths(path, fabric);
  std::vector<NamedText> files;
  Fabric copy = fabric;
  for (const FabricCurveField& field : fabric_curve_fields(copy)) {
    if (field.curve->has_value())
      files.push_back({paths[files.size()], format_curve_csv((*field.curve)->curve)});
  }
  files.push_back({path, format_fabric(fabric, fabric_id_of(path))});
  write_together(files);
}

}  // namespace fuai
