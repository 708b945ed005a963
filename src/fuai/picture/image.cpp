// The limits of image sizes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/image.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "fuai/core/error.h"
#include "fuai/picture/colour_map.h"

namespace fuai {

void check_image_size(int width, int height) {
  constexpr int kLeast = 16, kMost = 16384;
  if (width < kLeast || height < kLeast || width > kMost || height > kMost)
    throw Error(
        ErrorKind::kUsage,
        "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels cannot be made",
        {}, "choose a width and a height from 16 to 16384");
}

void make_alpha_straight(Image& image) {
  std::array<double, 256> linear{};
  for (std::size_t i = 0; i < linear.size(); ++i) linear[i] = srgb_to_linear(static_cast<double>(i) / 255.0);
  for (std::size_t i = 0; i + 3 < image.pixels.size(); i += 4) {
    const std::uint8_t alpha = image.pixels[i + 3];
    if (alpha == 0 || alpha == 255) continue;
    for (std::size_t k = i; k < i + 3; ++k) {
      const double straight = std::min(1.0, linear[image.pixels[k]] * 255.0 / alpha);
      image.pixels[k] = static_cast<std::uint8_t>(std::lround(255.0 * linear_to_srgb(straight)));
    }
  }
}

Image tile_images(const std::vector<Image>& images, int columns) {
  if (images.empty() || columns < 1) throw Error(ErrorKind::kUsage, "there is no image to tile");
  const int count = static_cast<int>(images.size());
  const int width = images.front().width, height = images.front().height;
  Image whole;
  whole.width = width * std::min(columns, count);
  whole.height = height * ((count + columns - 1) / columns);
  whole.pixels.assign(4 * static_cast<std::size_t>(whole.width) * static_cast<std::size_t>(whole.height),
                      255);
  for (int i = 0; i < count; ++i) {
    const Image& tile = images[static_cast<std::size_t>(i)];
    if (tile.width != width || tile.height != height)
      throw Error(ErrorKind::kUsage, "images of different sizes cannot be tiled");
    for (int y = 0; y < height; ++y) {
      std::copy_n(tile.at(0, y), 4 * width, whole.at(width * (i % columns), height * (i / columns) + y));
    }
  }
  return whole;
}

}  // namespace fuai
