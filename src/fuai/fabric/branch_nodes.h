// From measured branches to equally spaced nodes: noise removed, drift closed, what was changed reported.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fuai/fabric/identify.h"
#include "fuai/fabric/measured_curve.h"

namespace fuai {

/// The smallest change (least squares) that makes values non-decreasing: isotonic regression by pooling
/// neighbours. Thread class: set-up. @source Ayer et al. 1955 (pool adjacent violators)
std::vector<double> isotonic(std::span<const double> values);

/// Samples made monotone in strain and stress and read at `count` equally spaced strains from low to high;
/// beyond the first and last sample the end value is kept. @throws Error (kBadInput) with fewer than two
/// samples.
std::vector<double> resample_monotone(std::vector<CurveSample> samples, double low, double high,
                                      std::size_t count);

/// A curve whose range reaches both sides of zero (the smaller side at least a quarter of the larger).
bool is_two_sided(const MeasuredCurve& curve);

/// The steady loop of a two-sided curve. Branches are averaged where several overlap; the first loading from
/// the virgin state is used only where nothing else was measured; drift between the tips is spread linearly
/// over the loop.
/// @param notes gets a sentence for every correction
/// @throws Error (kBadInput) when there is no rising or no falling branch, or the branches cross by more than
/// noise.
LoopNodes loop_nodes(const MeasuredCurve& curve, std::size_t count, std::vector<std::string>& notes);

/// Virgin loading and last recovery of a one-sided curve with any number of growing cycles: the virgin curve
/// is made of the parts of each loading that go beyond all earlier strains. Errors as loop_nodes.
VirginNodes virgin_nodes(const MeasuredCurve& curve, std::size_t count, std::vector<std::string>& notes);

}  // namespace fuai
