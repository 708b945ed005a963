// A raster image in memory and its PNG encoding.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fuai {

/// Eight bits a channel, red green blue alpha, sRGB, straight (not premultiplied) alpha, rows from the top.
struct Image {
  int width = 0;                     ///< [pixel]
  int height = 0;                    ///< [pixel]
  std::vector<std::uint8_t> pixels;  ///< (height * width * 4)

  /// The four bytes of the pixel in column x of row y.
  const std::uint8_t* at(int x, int y) const { return pixels.data() + offset(x, y); }
  std::uint8_t* at(int x, int y) { return pixels.data() + offset(x, y); }

 private:
  std::size_t offset(int x, int y) const {
    return 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x));
  }
};

/// Throws Error kUsage unless both sides are between 16 and 16384 pixels. Thread class: any.
void check_image_size(int width, int height);

/// Images of equal size in rows of `columns`, white where the last row is short. Throws Error kUsage when
/// there is none, or sizes differ. Thread class: any.
Image tile_images(const std::vector<Image>& images, int columns);

/// Straight alpha instead of colours that were multiplied by alpha in linear light, as the painter leaves
/// them. Thread class: any.
void make_alpha_straight(Image& image);

/// Longest side that decode_png() takes [pixel].
inline constexpr int kLargestPictureSide = 8192;

/// The picture of a PNG file; what has no alpha is opaque. Throws Error kBadInput, naming the file, when it
/// is no PNG, broken or larger than kLargestPictureSide; kNoDevice when built without pictures.
/// @param name of the file, for messages. Thread class: set-up.
Image decode_png(std::string_view bytes, const std::string& name);

/// The bytes of a PNG file. Throws Error kNoDevice when built without pictures. Thread class: set-up.
std::string encode_png(const Image& image);

}  // namespace fuai
