// Tests a fabric and compares.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/kes_round_trip.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/experiments/fabric_plot.h"
#include "fuai/fabric/branch_nodes.h"
#include "fuai/fabric/curve_law.h"
#include "fuai/fabric/cycle_comparison.h"
#include "fuai/fabric/kes_parameters.h"
#include "fuai/io/number_text.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

/// What the fabric says of one test in one direction.
struct Own {
  const KnownCurve* curve = nullptr;  // measured as the instrument does it: its loop is compared with
  const PlayLaw* law = nullptr;
  std::string name;  // of the law
  std::vector<KesValue> stated;
  bool from_scalars = true;  // the law was made of `stated`, not of a curve
};

Own own_of(const Fabric& fabric, const FabricLaws& laws, Test test, Direction direction) {
  const auto i = static_cast<std::size_t>(direction);
  Own own;
  const auto take = [&](const std::optional<KnownCurve>& known, const PlayLaw& law) {
    own.curve = known ? &*known : nullptr;
    own.from_scalars = !known;
    own.law = &law;
  };
  own.name = std::string(to_string(test)) + "." + to_string(direction);
  if (test == Test::kBending) {
    const BendingMeasurement& b = fabric.bending[i];
    take(b.curve, laws.bending[i]);
    own.stated = {{Kes::kB, b.B.value}, {Kes::k2HB, b.hysteresis_2HB.value}};
  } else if (test == Test::kShear) {
    const ShearMeasurement& s = fabric.shear;
    take(s.curve, laws.shear);
    own.name = "shear";
    // A curve of one side comes from a stretched bias strip, far beyond the stops of FB1.
    if (own.curve && !is_two_sided(own.curve->curve)) own.curve = nullptr;
    own.stated = {
        {Kes::kG, s.G.value}, {Kes::k2HG, s.hysteresis_2HG.value}, {Kes::k2HG5, s.hysteresis_2HG5.value}};
  } else {
    const TensileMeasurement& t = fabric.tensile[i];
    take(t.curve, laws.tensile[i]);
    own.stated = {
        {Kes::kLT, t.LT.value}, {Kes::kWT, t.WT.value}, {Kes::kRT, t.RT.value}, {Kes::kEMT, t.EMT.value}};
  }
  return own;
}

/// A measured curve as one cycle on equally spaced nodes.
class OneCycle {
 public:
  explicit OneCycle(const MeasuredCurve& curve) {
    std::vector<std::string> notes;
    if (curve.test != Test::kTensile && is_two_sided(curve)) {
      LoopNodes loop = loop_nodes(curve, kLoopNodes, notes);
      low_ = loop.low, high_ = loop.high;
      rising_ = std::move(loop.up), falling_ = std::move(loop.down);
    } else {
      VirginNodes virgin = virgin_nodes(curve, kVirginNodes, notes);
      high_ = virgin.high;
      rising_ = std::move(virgin.load), falling_ = std::move(virgin.recovery);
    }
  }

  double low() const { return low_; }
  double high() const { return high_; }
  double peak() const { return rising_.back(); }
  /// Stress on a branch, straight between the nodes.
  double at(double strain, bool rises) const {
    const std::vector<double>& nodes = rises ? rising_ : falling_;
    const double place = (strain - low_) / (high_ - low_) * static_cast<double>(nodes.size() - 1);
    const double last = static_cast<double>(nodes.size() - 2);
    const double cell = std::clamp(std::floor(place), 0.0, last);
    const auto i = static_cast<std::size_t>(cell);
    return nodes[i] + (place - cell) * (nodes[i + 1] - nodes[i]);
  }

 private:
  double low_ = 0.0, high_ = 0.0;
  std::vector<double> rising_, falling_;
};

/// The stops and the law's past that a fabric asks for.
KesOptions options_of(const Own& own, const Fabric& fabric, const KesTest& test, Direction direction) {
  KesOptions options;
  options.direction = direction;
  options.reversals = test.reversals;
  options.spacing = test.spacing;
  if (own.curve) {
    const OneCycle cycle(own.curve->curve);
    options.high = test.test == Test::kTensile ? cycle.peak() : cycle.high();
    options.low = cycle.low();
    options.stop_strain = cycle.high();
    options.conditioned = cycle.low() < 0.0;
  } else if (test.test == Test::kTensile) {
    const Known& peak = fabric.tensile[static_cast<std::size_t>(direction)].peak_load;
    if (peak.has_value()) options.high = peak.value;
  }
  return options;
}

/// The law along the recorded strains.
MeasuredCurve law_along(const PlayLaw& law, const KesOptions& options, MeasuredCurve path) {
  PlayState state;
  if (options.conditioned) {
    for (double turn : {options.high, options.low, 0.0}) law.commit(turn, state);
  }
  for (CurveBranch& branch : path.branches) {
    for (CurveSample& s : branch.samples) s.stress = law.advance(s.strain, state).stress;
  }
  return path;
}

/// The fabric's loop at the recorded strains, in the convention of the record.
MeasuredCurve loop_along(const Own& own, const FabricLaws& laws, const KesOptions& options,
                         const MeasuredCurve& path) {
  if (own.curve && options.reversals.empty()) {
    const OneCycle cycle(own.curve->curve);
    MeasuredCurve loop = path;
    for (CurveBranch& branch : loop.branches) {
      const bool rising = rises(branch);
      for (CurveSample& s : branch.samples) s.stress = cycle.at(s.strain, rising);
    }
    return loop;
  }
  MeasuredCurve loop = law_along(*own.law, options, path);
  if (path.test != Test::kShear || options.stress) return loop;
  const PlayLaw& yarns = laws.tensile[static_cast<std::size_t>(options.direction)];
  return to_shear_force(std::move(loop), {options.tension, stretch_under(yarns, options.tension)});
}

/// The mean of two curves along the same path.
MeasuredCurve mean_of(MeasuredCurve a, const MeasuredCurve& b) {
  for (std::size_t k = 0; k < a.branches.size(); ++k) {
    for (std::size_t i = 0; i < a.branches[k].samples.size(); ++i) {
      CurveSample& s = a.branches[k].samples[i];
      const CurveSample& other = b.branches[k].samples[i];
      s = {0.5 * (s.strain + other.strain), 0.5 * (s.stress + other.stress)};
    }
  }
  return a;
}

/// A loop narrower than this part of its peak is closed: what is read off it is rounding.
constexpr double kClosed = 1e-4;

bool is_width(Kes quantity) {
  return quantity == Kes::k2HB || quantity == Kes::k2HG || quantity == Kes::k2HG5;
}

void close_loops(const MeasuredCurve& loop, std::vector<KesValue>& values) {
  double peak = 0.0;
  for (const CurveBranch& branch : loop.branches) {
    for (const CurveSample& s : branch.samples) peak = std::max(peak, std::abs(s.stress));
  }
  for (KesValue& v : values) {
    if (is_width(v.quantity) && std::abs(v.value) < kClosed * peak) v.value = 0.0;
  }
}

/// Cuts the plot to one series with a tenth around it: measured samples may lie far beyond the stops.
void show_only(const Series& series, Plot& plot) {
  const auto range = [](const std::vector<double>& values) {
    Range r{INFINITY, -INFINITY};
    for (double v : values) {
      if (!std::isfinite(v)) continue;
      r.low = std::min(r.low, v), r.high = std::max(r.high, v);
    }
    const double margin = 0.1 * (r.high - r.low);
    return Range{r.low - margin, r.high + margin};
  };
  plot.x_range = range(series.x);
  plot.y_range = range(series.y);
}

void add_notes(const FabricLaws& laws, const std::string& name, KesRoundTrip& trip) {
  for (const LawReport& report : laws.reports) {
    if (report.law != name) continue;
    for (const std::string& sentence : report.assumptions) {
      trip.notes.push_back(name);
      trip.notes.back().append(": ").append(sentence);
    }
  }
  if (trip.test.test != Test::kShear) return;
  trip.notes.push_back("read without the free edges: with them the specimen carries " +
                       brief_number(100.0 * trip.record.edge_share) + " % less per width");
  if (laws.shear_test.tension == 0.0) {
    trip.notes.emplace_back(
        "the fabric's shear numbers are those of the stress, without a tension's share: that of the "
        "instrument is taken off");
  }
}

}  // namespace

std::vector<KesValue> read_kes_parameters(const MeasuredCurve& curve) {
  switch (curve.test) {
    case Test::kBending: {
      const BendingParameters p = compute_bending_parameters(curve);
      return {{Kes::kB, p.B.mean()}, {Kes::k2HB, p.hysteresis_2HB.mean()}};
    }
    case Test::kShear: {
      const ShearParameters p = compute_shear_parameters(curve);
      return {{Kes::kG, p.G.mean()},
              {Kes::k2HG, p.hysteresis_2HG.mean()},
              {Kes::k2HG5, p.hysteresis_2HG5.mean()}};
    }
    case Test::kTensile: {
      const TensileParameters p = compute_tensile_parameters(curve);
      return {{Kes::kLT, p.LT}, {Kes::kWT, p.WT}, {Kes::kRT, p.RT}, {Kes::kEMT, p.EMT}};
    }
    case Test::kCompression:
      break;
  }
  throw Error(ErrorKind::kUsage, "there is no virtual compression tester");
}

KesRoundTrip run_kes_round_trip(const Fabric& fabric, const KesTest& test, const Progress& progress) {
  const FabricLaws laws = make_fabric_laws(fabric);
  KesRoundTrip trip;
  trip.test = test;
  std::vector<Direction> directions{test.direction.value_or(Direction::kWarp)};
  if (test.test == Test::kShear && !test.direction) directions = {Direction::kWarp, Direction::kWeft};
  const Own own = own_of(fabric, laws, test.test, directions.front());
  for (Direction direction : directions) {
    KesOptions options = options_of(own, fabric, test, direction);
    options.stress = laws.shear_test.tension == 0.0;
    if (laws.shear_test.tension > 0.0) options.tension = laws.shear_test.tension;
    const auto run = test.test == Test::kBending
                         ? run_kes_bending
                         : (test.test == Test::kShear ? run_kes_shear : run_kes_tensile);
    KesRecord record = run(laws, options, progress);
    MeasuredCurve loop = loop_along(own, laws, options, record.curve);
    if (direction != directions.front()) {
      record.curve = mean_of(trip.record.curve, record.curve);
      loop = mean_of(trip.loop, loop);
      record.stretch = 0.5 * (record.stretch + trip.record.stretch);
      record.edge_share = 0.5 * (record.edge_share + trip.record.edge_share);
      record.iterations += trip.record.iterations;
    }
    trip.record = std::move(record);
    trip.loop = std::move(loop);
    trip.high = options.high, trip.low = options.low;
  }
  trip.stated = own.stated;
  trip.loop_measured = own.curve && test.reversals.empty();
  trip.loop_rms = rms_over_peak(trip.record.curve, trip.loop);
  trip.simulated = read_kes_parameters(trip.record.curve);
  trip.input = read_kes_parameters(trip.loop);
  close_loops(trip.loop, trip.simulated);
  close_loops(trip.loop, trip.input);
  for (std::size_t i = 0; i < trip.input.size(); ++i) {
    if (own.from_scalars && test.reversals.empty() && !std::isnan(own.stated[i].value))
      trip.input[i] = own.stated[i];
  }
  add_notes(laws, own.name, trip);
  return trip;
}

Plot kes_plot(const Fabric& fabric, const KesRoundTrip& trip) {
  constexpr int kPale = 5, kGrey = 6;  // series_colour() numbers
  Plot plot = test_plot(trip.test.test);
  const std::string direction = trip.test.direction
                                    ? to_string(*trip.test.direction)
                                    : (trip.test.test == Test::kShear ? "mean of warp and weft" : "warp");
  plot.title = fabric.name + ", " + to_string(trip.test.test) + ", " + direction;
  const Direction d = trip.test.direction.value_or(Direction::kWarp);
  const auto i = static_cast<std::size_t>(d);
  const std::optional<KnownCurve>* measured = &fabric.shear.curve;
  if (trip.test.test == Test::kBending) measured = &fabric.bending[i].curve;
  if (trip.test.test == Test::kTensile) measured = &fabric.tensile[i].curve;
  if (*measured) {
    plot.series.push_back(
        curve_series((*measured)->curve, "measured, all cycles", SeriesStyle::kPoints, kGrey));
    plot.series.back().line_width = 1.0;
  }
  // The fabric's loop lies broad below the simulated one, so that both are seen where they agree.
  plot.series.push_back(curve_series(trip.loop,
                                     trip.loop_measured ? "measured, as one cycle" : "law of the fabric",
                                     SeriesStyle::kLine, kPale));
  plot.series.back().line_width = 6.0;
  plot.series.push_back(curve_series(trip.record.curve, "simulated instrument", SeriesStyle::kLine));
  plot.series.back().arrows = true;
  if (*measured && !trip.loop_measured) show_only(plot.series.back(), plot);
  return plot;
}

}  // namespace fuai
