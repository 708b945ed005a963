// Tells what a file is and hands it to its reader.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/fabric_import.h"

#include <utility>

#include "fuai/core/error.h"
#include "fuai/fabric/fab_report.h"
#include "fuai/fabric/from_curves.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/kes_sheet.h"
#include "fuai/io/text_file.h"
#include "fuai/io/u3m.h"

namespace fuai {
namespace {

enum class FileKind { kPhysicsJson, kFabricFile, kCurve, kSheet };

const char* to_string(FileKind kind) {
  switch (kind) {
    case FileKind::kPhysicsJson:
      return "U3M/FAB physics JSON";
    case FileKind::kFabricFile:
      return "a fabric file";
    case FileKind::kCurve:
      return "a curve file";
    case FileKind::kSheet:
      return "a KES sheet";
  }
  return "";
}

FileKind kind_of(const std::string& path, const std::string& text, bool told_to_be_curve) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && (text[first] == '{' || text[first] == '[') && !path.ends_with(".toml")) {
    return FileKind::kPhysicsJson;
  }
  if (path.ends_with(".toml")) return FileKind::kFabricFile;
  if (told_to_be_curve || text.substr(0, 200).find("fuai-curve/") != std::string::npos)
    return FileKind::kCurve;
  return FileKind::kSheet;
}

void add_curve(Fabric& fabric, const std::string& file, MeasuredCurve curve) {
  for (const std::string& warning : curve_warnings(curve)) fabric.warnings.push_back(warning);
  add_measured_curve(fabric, {std::move(curve), {ProvenanceKind::kMeasured, "curve file " + file, ""}});
}

/// What a fabric knows of a test is forgotten.
void forget(Fabric& fabric, Test test, Direction direction) {
  const auto i = static_cast<std::size_t>(direction);
  switch (test) {
    case Test::kBending:
      fabric.bending[i] = {};
      return;
    case Test::kShear:
      fabric.shear = {};
      return;
    case Test::kTensile:
      if (i < fabric.tensile.size()) fabric.tensile[i] = {};
      return;
    case Test::kCompression:
      fabric.compression = {};
      return;
  }
}

Fabric fabric_of_curves(const FabricImport& import) {
  Fabric fabric;
  fabric.name = import.name;
  if (!import.has_mass) {
    throw Error(ErrorKind::kUsage, "curve files do not say what the fabric weighs", {},
                "add --mass, e.g. --mass '16.3 mg/cm2'");
  }
  for (const std::string& file : import.files) add_curve(fabric, file, read_curve_csv(file, import.curves));
  return fabric;
}

}  // namespace

ImportedFabrics import_fabrics(const FabricImport& import) {
  const std::string& first = import.files.front();
  const FileKind kind = kind_of(first, read_text_file(first), import.curves.test.has_value());
  ImportedFabrics read{to_string(kind), {}, {}};
  if (kind == FileKind::kCurve) {
    read.fabrics.push_back(fabric_of_curves(import));
    return read;
  }
  if (import.files.size() > 1) {
    throw Error(ErrorKind::kUsage, "several files make one fabric only when all of them are curve files", {},
                "import '" + first + "' on its own");
  }
  if (kind == FileKind::kFabricFile) {
    read.fabrics.push_back(read_fabric_file(first));
  } else if (kind == FileKind::kSheet) {
    read.fabrics = read_kes_sheet(first);
  } else {
    FabFitReport report;
    read.fabrics.push_back(make_fabric_from_fab(read_u3m_physics(first), &report));
    read.fits = describe(report);
  }
  return read;
}

bool is_curve_file(const std::string& path) {
  return kind_of(path, read_text_file(path), false) == FileKind::kCurve;
}

void replace_by_curve(Fabric& fabric, const std::string& path) {
  MeasuredCurve curve = read_curve_csv(path);
  forget(fabric, curve.test, curve.direction);
  add_curve(fabric, path, std::move(curve));
}

}  // namespace fuai
