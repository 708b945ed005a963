// Reads KES parameters off branches: least-squares slopes, loop widths, works.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/kes_parameters.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "fuai/units/constants.h"

namespace fuai {

namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A branch mirrored to the positive side.
using Samples = std::vector<CurveSample>;

/// One loop of one side; either branch may be absent.
struct Cycle {
  std::optional<Samples> load;
  std::optional<Samples> unload;
};

Samples mirrored(const Samples& samples, double side) {
  Samples result = samples;
  for (CurveSample& s : result) s = {side * s.strain, side * s.stress};
  return result;
}

/// Loops of one side (+1 face, -1 back) in the order measured.
std::vector<Cycle> cycles_of_side(const MeasuredCurve& curve, double side) {
  std::vector<Cycle> cycles;
  std::optional<Samples> unload_before;
  bool open = false;  // the last cycle waits for its unloading branch
  for (const CurveBranch& branch : curve.branches) {
    if (branch.samples.size() < 2) continue;
    Samples samples = mirrored(branch.samples, side);
    const bool loads = rises(branch) == (side > 0.0);
    const bool reaches =
        std::any_of(samples.begin(), samples.end(), [](const CurveSample& s) { return s.strain > 0.0; });
    if (!reaches) continue;
    if (loads) {
      cycles.push_back({std::move(samples), {}});
      open = true;
    } else if (open) {
      cycles.back().unload = samples;
      unload_before = std::move(samples);
      open = false;
    } else {
      unload_before = std::move(samples);
    }
  }
  // A recording that ends with a loading branch closes its loop with the unloading branch before it.
  if (!cycles.empty() && !cycles.back().unload) cycles.back().unload = unload_before;
  return cycles;
}

/// Mean stress over all crossings of x (noise can cross more than once); nothing when x is never reached.
std::optional<double> stress_at(const Samples& samples, double x) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (samples[i].strain == x) {
      sum += samples[i].stress;
      ++count;
    } else if (i > 0 && (samples[i - 1].strain - x) * (samples[i].strain - x) < 0.0) {
      const CurveSample &a = samples[i - 1], &b = samples[i];
      sum += a.stress + (b.stress - a.stress) * (x - a.strain) / (b.strain - a.strain);
      ++count;
    }
  }
  if (count == 0) return std::nullopt;
  return sum / count;
}

/// Least-squares slope over the samples in [low, high]; nothing with fewer than two different abscissae or
/// when the branch does not span the window.
std::optional<double> slope_in(const Samples& samples, double low, double high) {
  double n = 0, sx = 0, sy = 0;
  double least = samples.front().strain, most = least;
  const double slack = 1e-9 * (high - low);
  const auto inside = [&](double x) { return x >= low - slack && x <= high + slack; };
  for (const CurveSample& s : samples) {
    least = std::min(least, s.strain), most = std::max(most, s.strain);
    if (!inside(s.strain)) continue;
    n += 1, sx += s.strain, sy += s.stress;
  }
  if (n < 2 || least > low + slack || most < high - slack) return std::nullopt;
  double sxx = 0, sxy = 0;
  for (const CurveSample& s : samples) {
    if (!inside(s.strain)) continue;
    sxx += (s.strain - sx / n) * (s.strain - sx / n);
    sxy += (s.strain - sx / n) * (s.stress - sy / n);
  }
  if (!(sxx > 0.0)) return std::nullopt;
  return sxy / sxx;
}

std::optional<double> width_at(const Cycle& cycle, double x) {
  if (!cycle.load || !cycle.unload) return std::nullopt;
  const std::optional<double> up = stress_at(*cycle.load, x), down = stress_at(*cycle.unload, x);
  if (!up || !down) return std::nullopt;
  return *up - *down;
}

/// What a slope-and-width test reads, in its own unit.
struct Window {
  double low, high;            // slope
  std::vector<double> widths;  // abscissae of the loop widths
  const char* slope_name;
  std::vector<const char*> width_names;
  const char* unit;  // for messages
  double unit_si;    // SI value of it
};

bool covers(const Cycle& cycle, const Window& window) {
  if (!cycle.load || !slope_in(*cycle.load, window.low, window.high)) return false;
  return std::all_of(window.widths.begin(), window.widths.end(),
                     [&](double x) { return width_at(cycle, x).has_value(); });
}

/// The cycle of a side by the rule at the head of kes_parameters.h.
template <class Covers>
std::optional<Cycle> choose_cycle(const std::vector<Cycle>& cycles, int wanted, Covers&& complete) {
  if (wanted >= 0) {
    if (static_cast<std::size_t>(wanted) >= cycles.size()) return std::nullopt;
    return cycles[static_cast<std::size_t>(wanted)];
  }
  for (auto it = cycles.rbegin(); it != cycles.rend(); ++it) {
    if (complete(*it)) return *it;
  }
  if (cycles.empty()) return std::nullopt;
  return cycles.back();
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

/// Slope first, then the widths, of one side; a sentence for each that is missing.
std::vector<double> read_side(const MeasuredCurve& curve, double side, const Window& window, int wanted,
                              std::vector<std::string>& missing) {
  const std::string side_name = side > 0.0 ? "face" : "back";
  std::vector<double> values(1 + window.widths.size(), kNan);
  const std::optional<Cycle> cycle =
      choose_cycle(cycles_of_side(curve, side), wanted, [&](const Cycle& c) { return covers(c, window); });
  if (!cycle) {
    missing.push_back(side_name + ": no such loading branch on this side");
    return values;
  }
  if (const auto slope = slope_in(*cycle->load, window.low, window.high)) {
    values[0] = *slope;
  } else {
    missing.push_back(side_name + ": " + window.slope_name + " needs a loading branch over " +
                      number(window.low / window.unit_si) + " to " + number(window.high / window.unit_si) +
                      " " + window.unit + " with at least two samples inside");
  }
  for (std::size_t k = 0; k < window.widths.size(); ++k) {
    if (const auto width = width_at(*cycle, window.widths[k])) {
      values[1 + k] = *width;
    } else {
      missing.push_back(side_name + ": " + window.width_names[k] + " needs both branches at " +
                        number(window.widths[k] / window.unit_si) + " " + window.unit);
    }
  }
  return values;
}

/// Works of one loading and unloading loop of the positive side.
struct WorkLoop {
  double work = kNan, recovered = kNan, peak_stress = kNan, peak_strain = kNan;
};

/// Trapezoid between two samples, cut at strain 0 where the segment crosses it.
double positive_trapezoid(CurveSample a, CurveSample b) {
  if (a.strain <= 0.0 && b.strain <= 0.0) return 0.0;
  const auto cut = [](const CurveSample& out, const CurveSample& in) {
    return CurveSample{0.0, out.stress + (in.stress - out.stress) * (-out.strain) / (in.strain - out.strain)};
  };
  if (a.strain < 0.0) a = cut(a, b);
  if (b.strain < 0.0) b = cut(b, a);
  return 0.5 * (a.stress + b.stress) * (b.strain - a.strain);
}

double loading_work(const Samples& load, std::size_t peak) {
  double work = 0.0;
  // A curve that starts above zero strain began at the origin: add the missing triangle.
  if (load.front().strain > 0.0) work += positive_trapezoid({0.0, 0.0}, load.front());
  for (std::size_t i = 1; i <= peak; ++i) work += positive_trapezoid(load[i - 1], load[i]);
  return work;
}

/// Work given back from the peak to the first zero of the stress.
double recovered_work(const CurveSample& peak, const Samples& unload) {
  double work = 0.0;
  CurveSample last = peak;
  for (const CurveSample& s : unload) {
    if (s.stress <= 0.0) {
      const double zero = last.strain + (s.strain - last.strain) * last.stress / (last.stress - s.stress);
      return work - positive_trapezoid(last, {zero, 0.0});
    }
    work -= positive_trapezoid(last, s);
    last = s;
  }
  return work;
}

WorkLoop read_work_loop(const MeasuredCurve& curve, int wanted, std::vector<std::string>& missing) {
  WorkLoop loop;
  const std::optional<Cycle> cycle = choose_cycle(
      cycles_of_side(curve, 1.0), wanted, [](const Cycle& c) { return c.load && c.unload.has_value(); });
  if (!cycle) {
    missing.push_back("no such loading branch");
    return loop;
  }
  const Samples& load = *cycle->load;
  const auto peak =
      std::max_element(load.begin(), load.end(),
                       [](const CurveSample& a, const CurveSample& b) { return a.stress < b.stress; });
  if (!(peak->stress > 0.0) || !(peak->strain > 0.0)) {
    missing.push_back("the loading branch carries no load");
    return loop;
  }
  loop.peak_stress = peak->stress;
  loop.peak_strain = peak->strain;
  loop.work = loading_work(load, static_cast<std::size_t>(peak - load.begin()));
  if (cycle->unload) {
    loop.recovered = recovered_work(*peak, *cycle->unload);
  } else {
    missing.push_back("resilience needs an unloading branch");
  }
  return loop;
}

}  // namespace

double TwoSided::mean() const {
  if (std::isnan(face)) return back;
  if (std::isnan(back)) return face;
  return 0.5 * (face + back);
}

BendingParameters compute_bending_parameters(const MeasuredCurve& curve, const KesReading& reading) {
  const Window window{0.5 * unit::kPerCentimetre,
                      1.5 * unit::kPerCentimetre,
                      {reading.bending_width_curvature},
                      "B",
                      {"2HB"},
                      "1/cm",
                      unit::kPerCentimetre};
  BendingParameters result;
  const std::vector<double> face = read_side(curve, 1.0, window, reading.cycle, result.missing);
  const std::vector<double> back = read_side(curve, -1.0, window, reading.cycle, result.missing);
  result.B = {face[0], back[0]};
  result.hysteresis_2HB = {face[1], back[1]};
  return result;
}

ShearParameters compute_shear_parameters(const MeasuredCurve& curve, const KesReading& reading) {
  const Window window{0.5 * unit::kDegree,
                      2.5 * unit::kDegree,
                      {0.5 * unit::kDegree, 5.0 * unit::kDegree},
                      "G",
                      {"2HG", "2HG5"},
                      "degrees",
                      unit::kDegree};
  ShearParameters result;
  const std::vector<double> face = read_side(curve, 1.0, window, reading.cycle, result.missing);
  const std::vector<double> back = read_side(curve, -1.0, window, reading.cycle, result.missing);
  result.G = {face[0], back[0]};
  result.hysteresis_2HG = {face[1], back[1]};
  result.hysteresis_2HG5 = {face[2], back[2]};
  return result;
}

TensileParameters compute_tensile_parameters(const MeasuredCurve& curve, const KesReading& reading) {
  TensileParameters result;
  const WorkLoop loop = read_work_loop(curve, reading.cycle, result.missing);
  result.peak_load = loop.peak_stress;
  result.EMT = loop.peak_strain;
  result.WT = loop.work;
  result.LT = loop.work / (0.5 * loop.peak_stress * loop.peak_strain);
  result.RT = loop.recovered / loop.work;
  return result;
}

CompressionParameters compute_compression_parameters(const MeasuredCurve& curve, double initial_thickness,
                                                     const KesReading& reading) {
  CompressionParameters result;
  const WorkLoop loop = read_work_loop(curve, reading.cycle, result.missing);
  result.peak_pressure = loop.peak_stress;
  result.WC = loop.work;
  result.LC = loop.work / (0.5 * loop.peak_stress * loop.peak_strain);
  result.RC = loop.recovered / loop.work;
  result.T0 = initial_thickness;
  result.Tm = initial_thickness - loop.peak_strain;
  if (std::isnan(initial_thickness)) result.missing.push_back("T0 and Tm need the initial thickness");
  return result;
}

}  // namespace fuai
