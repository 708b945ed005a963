// The tables behind the colour maps and the sRGB transfer function.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/colour_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "fuai/core/assertion.h"

namespace fuai {
namespace {

constexpr Colour rgb(int hex) {
  return {((hex >> 16) & 0xff) / 255.0, ((hex >> 8) & 0xff) / 255.0, (hex & 0xff) / 255.0, 1.0};
}

// Viridis at nine equal steps; the straight lines between them stay within 0.02 of the original.
constexpr std::array kViridis = {rgb(0x440154), rgb(0x472D7B), rgb(0x3B528B), rgb(0x2C728E), rgb(0x21918C),
                                 rgb(0x28AE80), rgb(0x5EC962), rgb(0xADDC30), rgb(0xFDE725)};
constexpr std::array kBlueRed = {rgb(0x2166AC), rgb(0x67A9CF), rgb(0xD1E5F0), rgb(0xF7F7F7),
                                 rgb(0xFDDBC7), rgb(0xEF8A62), rgb(0xB2182B)};
// The first two are warp and weft, the third is bias.
constexpr std::array kSeries = {rgb(0x0072B2), rgb(0xD55E00), rgb(0x009E73), rgb(0xCC79A7),
                                rgb(0xE69F00), rgb(0x56B4E9), rgb(0x333333)};

Colour between(std::span<const Colour> stops, double t) {
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(stops.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), stops.size() - 2);
  const double w = place - static_cast<double>(i);
  const Colour &a = stops[i], &b = stops[i + 1];
  return {std::lerp(a.red, b.red, w), std::lerp(a.green, b.green, w), std::lerp(a.blue, b.blue, w), 1.0};
}

}  // namespace

Colour sample_colour_map(ColourMap map, double t) {
  if (std::isnan(t)) return kNoValueColour;
  return map == ColourMap::kSequential ? between(kViridis, t) : between(kBlueRed, t);
}

Colour series_colour(int index) {
  FUAI_ASSERT(index >= 0);
  return kSeries[static_cast<std::size_t>(index) % kSeries.size()];
}

double srgb_to_linear(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double linear_to_srgb(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

}  // namespace fuai
