// The limits of image sizes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/image.h"

#include <algorithm>

#include "fuai/core/error.h"

namespace fuai {

void check_image_size(int width, int height) {
  constexpr int kLeast = 16, kMost = 16384;
  if (width < kLeast || height < kLeast || width > kMost || height > kMost)
    throw Error(
        ErrorKind::kUsage,
        "a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels cannot be made",
        {}, "choose a width and a height from 16 to 16384");
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
