// Applies the factors of the sliders to the laws of a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_setup.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/fabric/play_law.h"
#include "fuai/io/fabric_import.h"
#include "fuai/io/fabric_library.h"

namespace fuai {
namespace {

constexpr auto kWarp = static_cast<std::size_t>(Direction::kWarp);
constexpr auto kWeft = static_cast<std::size_t>(Direction::kWeft);
constexpr auto kBias = static_cast<std::size_t>(Direction::kBias);

/// What the bias law is to be multiplied with: twist grows with the geometric mean of warp and weft, as where
/// it is assumed, so that B45 = (B1 + B2 + 4 Bt) / 4 becomes (p B1 + q B2 + sqrt(p q) 4 Bt) / 4.
double bias_factor(const FabricLaws& laws, double p, double q) {
  const double B1 = bending_rigidity(laws.bending[kWarp]), B2 = bending_rigidity(laws.bending[kWeft]);
  const double B45 = bending_rigidity(laws.bending[kBias]);
  const double mean = std::sqrt(p * q);
  if (p == q || !(B45 > 0.0)) return mean;
  const double factor = (p * B1 + q * B2 + mean * (4.0 * B45 - B1 - B2)) / (4.0 * B45);
  return factor > 0.0 ? factor : mean;  // a bias far softer than its yarns allow
}

constexpr std::string_view kAnd = " + ";

bool is_file(const std::string& path) {
  std::error_code code;  // what cannot be looked at is told when it is read
  return std::filesystem::is_regular_file(path, code);
}

/// Where the last curve of a source begins, its mark before it; npos: there is none. Names of files may hold
/// the mark, too.
std::size_t last_curve(const std::string& source) {
  if (is_file(source)) return std::string::npos;
  const std::size_t last = source.rfind(kAnd);
  for (std::size_t at = last; at != std::string::npos && at > 0; at = source.rfind(kAnd, at - 1))
    if (is_file(source.substr(at + kAnd.size()))) return at;
  return last;
}

/// Files are named by it.
std::string as_id(std::string name) {
  std::replace(name.begin(), name.end(), '/', '-');
  return name;
}

ViewFabric with_measured(ViewFabric fabric, const std::string& path) {
  const std::string curve = std::filesystem::path(path).stem().string();
  replace_by_curve(fabric.measured, path);
  fabric.source += std::string(kAnd) + path;
  fabric.measured.name += std::string(kAnd) + curve;
  fabric.measured.id += "-" + curve;
  return fabric;
}

}  // namespace

std::string with_curve(std::string source, const std::string& path) {
  const std::string mark = std::string(kAnd) + path;
  for (std::size_t at = source.find(mark); at != std::string::npos; at = source.find(mark, at)) {
    const std::size_t end = at + mark.size();
    if (end == source.size() || source.compare(end, kAnd.size(), kAnd) == 0)
      source.erase(at, mark.size());
    else
      at = end;
  }
  return source + mark;
}

ViewFabric load_view_fabric(const std::string& source) {
  if (const std::size_t at = last_curve(source); at != std::string::npos)
    return with_measured(load_view_fabric(source.substr(0, at)), source.substr(at + kAnd.size()));
  ViewFabric fabric;
  fabric.source = source;
  const bool bundled = source.find('/') == std::string::npos && source.find('.') == std::string::npos;
  if (bundled || source.ends_with(".toml")) {
    fabric.measured = load_fabric(source);
    return fabric;
  }
  if (is_curve_file(source)) {
    throw Error(ErrorKind::kBadInput, "a curve is only a part of a fabric", {source, 0, 0, ""},
                "name the fabric before it: 'wool-tropical + CURVE.csv'");
  }
  FabricImport import;
  import.files = {source};
  ImportedFabrics read = import_fabrics(import);
  const std::size_t count = read.fabrics.size();
  fabric.measured = std::move(read.fabrics.front());
  if (count > 1)
    fabric.measured.warnings.push_back("the first of " + std::to_string(count) + " fabrics of this sheet");
  fabric.measured.id = as_id(fabric.measured.id.empty() ? fabric.measured.name : fabric.measured.id);
  return fabric;
}

bool ViewFabric::changed() const noexcept {
  return std::any_of(factors.begin(), factors.end(), [](double factor) { return factor != 1.0; });
}

FabricLaws make_view_laws(const ViewFabric& fabric) {
  for (const double factor : fabric.factors) {
    if (!(factor >= kLeastFactor && factor <= kMostFactor)) {
      throw Error(ErrorKind::kUsage, "a factor of '" + fabric.measured.name + "' is out of range", {},
                  "take 0.1 to 10");
    }
  }
  const auto factor = [&](FabricFactor which) { return fabric.factors[static_cast<std::size_t>(which)]; };
  FabricLaws laws = make_fabric_laws(fabric.measured);
  if (!fabric.changed()) return laws;
  laws.areal_mass *= factor(FabricFactor::kWeight);
  const double warp = factor(FabricFactor::kWarpBending), weft = factor(FabricFactor::kWeftBending);
  const double friction = factor(FabricFactor::kBendingFriction);
  const double bias = bias_factor(laws, warp, weft);
  laws.bending[kWarp] = scaled(laws.bending[kWarp], warp, friction);
  laws.bending[kWeft] = scaled(laws.bending[kWeft], weft, friction);
  laws.bending[kBias] = scaled(laws.bending[kBias], bias, friction);
  laws.shear = scaled(laws.shear, factor(FabricFactor::kShear), factor(FabricFactor::kShearFriction));
  for (const auto& [direction, which] :
       {std::pair{kWarp, FabricFactor::kWarpTension}, std::pair{kWeft, FabricFactor::kWeftTension}})
    laws.tensile[direction] = scaled(laws.tensile[direction], factor(which), factor(which));
  return laws;
}

}  // namespace fuai
