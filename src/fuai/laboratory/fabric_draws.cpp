// Draws fabrics within what is not known of one.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_draws.h"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "fuai/core/error.h"
#include "fuai/fabric/assumptions.h"
#include "fuai/fabric/bending_rules.h"
#include "fuai/fabric/laws.h"
#include "fuai/laboratory/drape_material.h"

namespace fuai {
namespace {

/// Random numbers that are the same with every library.
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}
  /// In (0, 1).
  double uniform() { return (static_cast<double>(engine_() >> 11) + 0.5) * 0x1.0p-53; }
  /// In (-1, 1).
  double place() { return 2.0 * uniform() - 1.0; }
  double normal() {
    const double radius = std::sqrt(-2.0 * std::log(uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::mt19937_64 engine_;
};

void scale(std::optional<KnownCurve>& curve, double factor) {
  if (!curve) return;
  for (auto& branch : curve->curve.branches)
    for (auto& sample : branch.samples) sample.stress *= factor;
}

void scale(Known& number, double factor) {
  if (number.has_value()) number.value *= factor;
}

/// Everything drawn at once, so that each number has its own place in the sequence whatever the fabric has.
struct Drawn {
  double friction;                 ///< place between the ends of 2HB / B, shared: one fibre
  std::array<double, 3> B, twoHB;  ///< normal
  double G, twoHG, twoHG5;         ///< normal
  double shear, twist;             ///< place, uniform

  explicit Drawn(Chance chance) {
    friction = chance.place();
    for (double& x : B) x = chance.normal();
    for (double& x : twoHB) x = chance.normal();
    G = chance.normal(), twoHG = chance.normal(), twoHG5 = chance.normal();
    shear = chance.uniform(), twist = chance.uniform();
  }
};

void draw_bending(Fabric& fabric, const FabricUncertainty& u, const Drawn& z) {
  const double ratio = hysteresis_rule(fabric).per_bending * std::pow(assumed::kHysteresisSpread, z.friction);
  for (std::size_t i = 0; i < fabric.bending.size(); ++i) {
    BendingMeasurement& bending = fabric.bending[i];
    if (i < 2 && u.bending[i]) {
      const BendingFit& fit = *u.bending[i];
      bending.B.value = fit.at(z.friction) * std::exp(fit.noise * z.B[u.one_fit ? 0 : i]);
      bending.hysteresis_2HB.value = fit.ratio_at(z.friction) * bending.B.value;
      continue;
    }
    scale(bending.B, std::exp(u.scatter * z.B[i]));
    scale(bending.curve, std::exp(u.scatter * z.B[i]));
    if (bending.hysteresis_2HB.has_value()) {
      scale(bending.hysteresis_2HB, std::exp(u.scatter * z.twoHB[i]));
    } else if (bending.B.has_value()) {
      bending.hysteresis_2HB.value = ratio * bending.B.value;
    }
  }
}

void draw_shear(Fabric& fabric, const FabricUncertainty& u, const Drawn& z) {
  ShearMeasurement& shear = fabric.shear;
  if (!shear.G.has_value() && !shear.curve) {
    shear.G.value = kLeastShearG * std::pow(kMostShearG / kLeastShearG, z.shear);
    return;
  }
  scale(shear.G, std::exp(u.scatter * z.G));
  scale(shear.curve, std::exp(u.scatter * z.G));
  scale(shear.hysteresis_2HG, std::exp(u.scatter * z.twoHG));
  scale(shear.hysteresis_2HG5, std::exp(u.scatter * z.twoHG5));
}

/// Gives a fabric without a bias test the twist that was drawn.
void draw_twist(Fabric& fabric, const Drawn& z) {
  BendingMeasurement& bias = fabric.bending[static_cast<std::size_t>(Direction::kBias)];
  if (bias.B.has_value() || bias.curve) return;
  const FabricLaws laws = make_fabric_laws(fabric);
  const double share = kMostTwistShare * z.twist;
  const auto friction = [&](int i) {
    return 2.0 * laws.bending[static_cast<std::size_t>(i)].friction().evaluate(unit::kPerCentimetre).value;
  };
  bias.B.value = bias_of(bending_rigidity(laws.bending[0]), bending_rigidity(laws.bending[1]), share);
  bias.hysteresis_2HB.value = bias_of(friction(0), friction(1), share);
}

}  // namespace

Fabric draw_fabric(const Fabric& fabric, const FabricUncertainty& uncertainty, std::uint64_t seed) {
  // Scatter may put numbers together that no law has, such as a 2HG5 out of proportion: then once more.
  constexpr std::uint64_t kAttempts = 20;
  for (std::uint64_t attempt = 0;; ++attempt) {
    Fabric drawn = fabric;
    try {
      const Drawn z(Chance(seed + (attempt << 32)));
      draw_bending(drawn, uncertainty, z);
      draw_shear(drawn, uncertainty, z);
      draw_twist(drawn, z);
      make_fabric_laws(drawn);
      return drawn;
    } catch (const Error&) {
      if (attempt + 1 == kAttempts) throw;
    }
  }
}

std::vector<std::string> drawn_numbers(const Fabric& fabric, const FabricUncertainty& u, bool drape) {
  char percent[40], between[80];
  std::snprintf(percent, sizeof percent, "%.3g %%", 100.0 * u.scatter);
  std::vector<std::string> sentences;
  bool measured = false, friction = false;
  for (std::size_t i = 0; i < fabric.bending.size(); ++i) {
    const BendingMeasurement& bending = fabric.bending[i];
    const bool fitted = i < 2 && u.bending[i].has_value();
    measured = measured || (!fitted && (bending.B.has_value() || bending.curve));
    friction = friction || fitted ||
               (bending.B.has_value() && !bending.hysteresis_2HB.has_value() && !bending.curve);
    if (fitted)
      sentences.push_back(std::string("B ") + to_string(static_cast<Direction>(i)) +
                          " within its fit, together with its friction");
  }
  if (measured) sentences.push_back("measured bending scatters by " + std::string(percent));
  if (friction) {
    const std::array<double, 3> ratio = hysteresis_ratios(fabric);
    std::snprintf(between, sizeof between, "2HB between %.3g and %.3g /cm times B",
                  ratio[0] / unit::kPerCentimetre, ratio[2] / unit::kPerCentimetre);
    sentences.emplace_back(between);
  }
  if (!drape) return sentences;
  const bool shear = fabric.shear.G.has_value() || fabric.shear.curve;
  sentences.push_back(shear ? "measured shear scatters by " + std::string(percent)
                            : "G between 0.3 and 2 gf/(cm deg), 2HG with it");
  const BendingMeasurement& bias = fabric.bending[static_cast<std::size_t>(Direction::kBias)];
  if (!bias.B.has_value() && !bias.curve)
    sentences.emplace_back("twist stiffness between 0 and 0.5 sqrt(B warp B weft)");
  return sentences;
}

}  // namespace fuai
