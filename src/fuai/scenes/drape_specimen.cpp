// Cuts, clamps and perturbs the specimen.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/scenes/drape_specimen.h"

#include <array>
#include <cmath>
#include <random>

#include "fuai/core/error.h"
#include "fuai/scenes/smooth_noise.h"

namespace fuai {
namespace {

/// Wavelengths of the unevenness [m]: a hand's breadth down to the least fold.
constexpr double kShortestWave = 0.03, kLongestWave = 0.12;

/// One stream of random numbers for each use of a seed, so that leaving one out does not move the others.
enum class Stream : std::uint64_t { kShift = 1, kDensity = 2, kVelocity = 3 };

std::uint64_t stream_seed(std::uint64_t seed, Stream stream) {
  std::seed_seq sequence{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32U),
                         static_cast<std::uint32_t>(stream)};
  std::array<std::uint32_t, 2> words{};
  sequence.generate(words.begin(), words.end());
  return words[0] | static_cast<std::uint64_t>(words[1]) << 32U;
}

SmoothNoise noise_of(const DrapeGeometry& geometry, std::uint64_t seed, Stream stream) {
  return {stream_seed(seed, stream), kShortestWave, kLongestWave, 0.5 * geometry.specimen};
}

bool positive(double x) { return x > 0.0 && std::isfinite(x); }

void check(const DrapeGeometry& g) {
  if (!positive(g.disc) || !positive(g.specimen) || !(g.disc < g.specimen)) {
    throw Error(ErrorKind::kUsage, "the disc of a drape tester must be smaller than the specimen", {},
                "take 18cm and 30cm, or 12.7cm and 25.4cm");
  }
  if (!fits(g)) {
    throw Error(ErrorKind::kUsage, "the spacing does not suit the drape tester", {},
                "take at most a third of the overhang and a quarter of the disc, such as 5mm");
  }
}

void make_uneven(const DrapeGeometry& geometry, std::uint64_t seed, double size, ClothModel& model) {
  if (size == 0.0) return;
  const SmoothNoise noise = noise_of(geometry, seed, Stream::kDensity);
  double before = 0.0, after = 0.0;
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    double& area = model.node_area[static_cast<std::size_t>(slot)];
    before += area;
    area *= 1.0 + size * noise.at(model.material(slot % model.columns, slot / model.columns));
    after += area;
  }
  for (double& area : model.node_area) area *= before / after;
}

}  // namespace

bool fits(const DrapeGeometry& g) noexcept {
  return positive(g.spacing) && g.spacing <= g.overhang() / 3.0 && g.spacing <= 0.25 * g.disc;
}

ClothPieceSpec make_drape_spec(const DrapeGeometry& geometry, double areal_mass) {
  ClothPieceSpec spec;
  spec.outline = make_disc_outline(geometry.specimen);
  spec.spacing = geometry.spacing;
  spec.areal_mass = areal_mass;
  spec.clamps.push_back({DiscRegion{Vec2::Zero(), 0.5 * geometry.disc}, true});
  return spec;
}

ClothModel make_drape_model(const DrapeGeometry& geometry, double areal_mass, std::uint64_t seed,
                            const DrapePerturbation& perturbation) {
  check(geometry);
  ClothPieceSpec spec = make_drape_spec(geometry, areal_mass);
  if (perturbation.shift) {
    std::mt19937_64 random(stream_seed(seed, Stream::kShift));
    std::uniform_real_distribution<double> share(0.0, 1.0);
    spec.lattice_shift.x() = share(random);
    spec.lattice_shift.y() = share(random);
  }
  ClothModel model = make_cloth_model(spec);
  make_uneven(geometry, seed, perturbation.density, model);
  return model;
}

ClothState make_drape_start(const DrapeGeometry& geometry, const ClothModel& model, std::uint64_t seed,
                            const DrapePerturbation& perturbation) {
  ClothState state = make_cloth_state(model);
  if (perturbation.velocity == 0.0) return state;
  const SmoothNoise noise = noise_of(geometry, seed, Stream::kVelocity);
  for (int slot = 0; slot < model.slot_count(); ++slot) {
    const auto i = static_cast<std::size_t>(slot);
    if (model.live[i] == 0 || model.fixed[i] != 0) continue;
    const Vec2 point = model.material(slot % model.columns, slot / model.columns);
    state.velocities[i].z() = perturbation.velocity * noise.at(point);
  }
  return state;
}

}  // namespace fuai
