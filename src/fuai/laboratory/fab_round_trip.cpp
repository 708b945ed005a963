// Tests, reads, compares.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fab_round_trip.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fuai/experiments/fabric_plot.h"
#include "fuai/fabric/buckling.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// Stress on a branch of rising or falling strain; 0 beyond its end toward slack.
double stress_on(const CurveBranch& branch, double strain) {
  const std::vector<CurveSample>& s = branch.samples;
  for (std::size_t i = 1; i < s.size(); ++i) {
    const CurveSample &a = s[i - 1], &b = s[i];
    if ((a.strain - strain) * (b.strain - strain) > 0.0 || a.strain == b.strain) continue;
    return a.stress + (b.stress - a.stress) * (strain - a.strain) / (b.strain - a.strain);
  }
  const CurveSample& far = s.front().strain > s.back().strain ? s.front() : s.back();
  return strain > far.strain ? far.stress : 0.0;
}

double largest(const MeasuredCurve& curve) {
  double peak = 0.0;
  for (const CurveBranch& branch : curve.branches) {
    for (const CurveSample& s : branch.samples) peak = std::max(peak, std::abs(s.stress));
  }
  return peak;
}

/// Where the measured cycles turn back.
std::vector<double> turns_of(const MeasuredCurve& curve) {
  std::vector<double> turns;
  for (const CurveBranch& branch : curve.branches) {
    if (rises(branch)) turns.push_back(branch.samples.back().strain);
  }
  return turns;
}

double rms_of(const MeasuredCurve& measured, const MeasuredCurve& simulated) {
  double square = 0.0, count = 0.0;
  const std::size_t branches = std::min(measured.branches.size(), simulated.branches.size());
  for (std::size_t b = 0; b < branches; ++b) {
    for (const CurveSample& s : measured.branches[b].samples) {
      square += std::pow(stress_on(simulated.branches[b], s.strain) - s.stress, 2);
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(square / count) / largest(measured) : 0.0;
}

}  // namespace

FabBucklingTrip run_fab_buckling_trip(const Fabric& fabric, Direction direction, const Progress& progress) {
  const FabricLaws laws = make_fabric_laws(fabric);
  const auto d = static_cast<std::size_t>(direction);
  FabBucklingTrip trip;
  trip.record = record_fab_buckling(laws, direction, progress);
  trip.fit = fit_buckling(trip.record, direction);
  double square = 0.0, peak = 0.0;
  for (FabTest test : {FabTest::kD1, FabTest::kU1}) {
    const FabStripTest& engine = trip.record.strip(direction, test);
    BucklingStrip strip;
    strip.free_length = engine.length;
    strip.areal_mass = laws.areal_mass;
    strip.upwards = test == FabTest::kU1;
    std::vector<double> distances;
    for (const auto& branch : engine.branches) {
      for (const FabSample& s : branch) {
        distances.push_back(s.clamp_distance);
        trip.engine.push_back(s.force);
      }
    }
    const BucklingPath path = simulate_buckling(strip, laws.bending[d], distances);
    for (double force : path.force) trip.strip.push_back(force * engine.width);
    trip.distance.insert(trip.distance.end(), distances.begin(), distances.end());
  }
  for (std::size_t i = 0; i < trip.engine.size(); ++i) {
    square += std::pow(trip.engine[i] - trip.strip[i], 2);
    peak = std::max(peak, std::abs(trip.strip[i]));
  }
  trip.rms = std::sqrt(square / static_cast<double>(trip.engine.size())) / peak;
  trip.simulated = {{Kes::kB, trip.fit.B}, {Kes::k2HB, trip.fit.hysteresis_2HB}};
  trip.stated = {{Kes::kB, fabric.bending[d].B.value}, {Kes::k2HB, fabric.bending[d].hysteresis_2HB.value}};
  return trip;
}

FabStretchTrip run_fab_stretch_trip(const Fabric& fabric, Direction direction) {
  const FabricLaws laws = make_fabric_laws(fabric);
  const TensileMeasurement& tensile = fabric.tensile[static_cast<std::size_t>(direction)];
  FabStretchTrip trip;
  std::vector<double> turns;
  if (tensile.curve) {
    trip.loop = tensile.curve->curve;
    turns = turns_of(*trip.loop);
  }
  trip.curve = run_fab_stretch(laws, direction, turns);
  if (trip.loop) trip.rms = rms_of(*trip.loop, trip.curve);
  trip.simulated = read_kes_parameters(trip.curve);
  if (trip.loop) {
    trip.stated = read_kes_parameters(*trip.loop);
  } else {
    for (const KesValue& v : trip.simulated) trip.stated.push_back({v.quantity, NAN});
  }
  return trip;
}

Plot fab_buckling_plot(const std::string& title, const FabBucklingTrip& trip) {
  constexpr int kPale = 5;
  Plot plot;
  plot.title = title;
  plot.x_label = "clamp distance [cm]";
  plot.y_label = "force of the strip [gf]";
  const std::size_t half = trip.distance.size() / 2;
  const auto series = [&](const std::vector<double>& force, std::size_t first, std::size_t end) {
    Series s;
    for (std::size_t i = first; i < end; ++i) {
      s.x.push_back(trip.distance[i] / unit::kCentimetre);
      s.y.push_back(force[i] / unit::kGramForce);
    }
    return s;
  };
  for (std::size_t k = 0; k < 2; ++k) {
    const std::size_t first = k * half, end = k == 0 ? half : trip.distance.size();
    Series below = series(trip.strip, first, end), above = series(trip.engine, first, end);
    below.colour = kPale;
    below.line_width = 6.0;
    if (k == 0) below.label = "one-dimensional strip";
    above.label = k == 0 ? "engine, D1: downwards" : "engine, U1: upwards";
    above.colour = static_cast<int>(k);
    plot.series.push_back(std::move(below));
    plot.series.push_back(std::move(above));
  }
  return plot;
}

Plot fab_stretch_plot(const std::string& title, const FabStretchTrip& trip) {
  constexpr int kGrey = 6;
  Plot plot = test_plot(Test::kTensile);
  plot.title = title;
  if (trip.loop) {
    plot.series.push_back(curve_series(*trip.loop, "measured", SeriesStyle::kPoints, kGrey));
    plot.series.back().line_width = 1.0;
  }
  plot.series.push_back(curve_series(trip.curve, "engine", SeriesStyle::kLine));
  return plot;
}

}  // namespace fuai
