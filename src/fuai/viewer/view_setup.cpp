// Applies the factors of the sliders to the laws of a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/viewer/view_setup.h"

#include <algorithm>
#include <cmath>

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

}  // namespace

ViewFabric load_view_fabric(const std::string& source) {
  ViewFabric fabric;
  fabric.source = source;
  const bool bundled = source.find('/') == std::string::npos && source.find('.') == std::string::npos;
  if (bundled || source.ends_with(".toml")) {
    fabric.measured = load_fabric(source);
    return fabric;
  }
  FabricImport import;
  import.files = {source};
  ImportedFabrics read = import_fabrics(import);
  const std::size_t count = read.fabrics.size();
  fabric.measured = std::move(read.fabrics.front());
  if (count > 1)
    fabric.measured.warnings.push_back("the first of " + std::to_string(count) + " fabrics of this sheet");
  if (fabric.measured.id.empty()) fabric.measured.id = fabric.measured.name;
  std::replace(fabric.measured.id.begin(), fabric.measured.id.end(), '/', '-');  // files are named by it
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
