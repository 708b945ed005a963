// The parts of an HTML page that set fabrics side by side.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include "fuai/experiments/html_page.h"
#include "fuai/laboratory/fabric_comparison.h"
#include "fuai/laboratory/fabric_study.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// "+0.5", "−12", "0.0": a difference with the sign of what is shown. Thread class: any.
std::string signed_number(double value, int decimals);

/// Values of all fabrics, KES units, with their kinds. Thread class: set-up.
HtmlTable value_table(const FabricComparison& comparison);

/// Differences from the first fabric in percent and in just-noticeable differences, where there are any.
/// Thread class: set-up.
HtmlTable difference_table(const FabricComparison& comparison);

/// One sentence a threshold: what it is, where it holds, why it is used or not, who measured it. Thread
/// class: any.
std::vector<std::string> threshold_sentences(const FabricComparison& comparison);

/// The loops of all fabrics in one plot each: bending and tension of the warp and of the weft, shear. Thread
/// class: set-up.
PlotGrid comparison_plots(std::span<const FabricStudy* const> studies);

}  // namespace fuai
