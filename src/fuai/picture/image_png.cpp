// PNG encoding with stb_image_write.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/image.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>

#include "fuai/core/assertion.h"
#include "fuai/core/error.h"

namespace fuai {

std::string encode_png(const Image& image) {
  FUAI_ASSERT(image.pixels.size() ==
              4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  std::string bytes;
  const auto append = [](void* context, void* data, int size) {
    static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                               static_cast<std::size_t>(size));
  };
  if (stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.pixels.data(),
                             4 * image.width) == 0)
    throw Error(ErrorKind::kCheckFailed, "the PNG encoder ran out of memory");
  return bytes;
}

}  // namespace fuai
