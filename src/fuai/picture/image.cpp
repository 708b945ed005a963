// The limits of image sizes.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/image.h"

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

}  // namespace fuai
