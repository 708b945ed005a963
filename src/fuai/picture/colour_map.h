// Colours of pictures: colour maps for values, fixed colours for series and for warp and weft.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/core/types.h"

namespace fuai {

/// A colour in sRGB encoding, straight alpha; each part in [0, 1].
struct Colour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double alpha = 1.0;
};

enum class ColourMap {
  kSequential,  ///< dark violet over green to yellow, lightness rises monotonically (viridis)
  kDiverging,   ///< blue over white to red, white in the middle
};

/// The colour of a map. Thread class: any.
/// @param t [1] place in the map, clamped to [0, 1]; NaN gives the grey of "no value"
/// @source viridis: S. van der Walt and N. Smith 2015 (CC0); diverging: C. Brewer's RdBu
Colour sample_colour_map(ColourMap map, double t);

/// The grey that stands for "no value".
inline constexpr Colour kNoValueColour{0.62, 0.62, 0.62, 1.0};

/// Colour number `index` of a series, repeating after seven; distinguishable with colour-blind eyes and on
/// white. Thread class: any.
/// @param index any integer >= 0
/// @source M. Okabe and K. Ito 2008, Color Universal Design, reordered, the yellow left out
Colour series_colour(int index);

/// Number of the series colour that belongs to a yarn direction, the same in every picture and plot.
constexpr int series_index(Direction direction) { return static_cast<int>(direction); }

/// The colour of warp, weft or bias, the same in every picture and plot. Thread class: any.
inline Colour yarn_colour(Direction direction) { return series_colour(series_index(direction)); }

/// One channel of a colour from sRGB encoding to linear light, and back; both on [0, 1].
/// @source IEC 61966-2-1
double srgb_to_linear(double encoded);
double linear_to_srgb(double linear);

}  // namespace fuai
