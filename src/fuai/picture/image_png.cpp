// PNG encoding with stb_image_write, decoding with stb_image.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/image.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb/stb_image_write.h>
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include <algorithm>
#include <limits>
#include <memory>

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

Image decode_png(std::string_view bytes, const std::string& name) {
  const auto fail = [&](const std::string& what, const char* cure) {
    throw Error(ErrorKind::kBadInput, what, {name, 0, 0, ""}, cure);
  };
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  if (!bytes.starts_with(kSignature) ||
      bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    fail("this is no PNG picture", "save it as PNG");
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  Image image;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0)
    fail("the PNG picture is broken or cut off", "save it again");
  if (std::max(image.width, image.height) > kLargestPictureSide)
    fail("the picture has " + std::to_string(image.width) + " x " + std::to_string(image.height) +
             " pixels, more than " + std::to_string(kLargestPictureSide) + " a side",
         "make it smaller");
  const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
      stbi_load_from_memory(data, size, &image.width, &image.height, &channels, 4), stbi_image_free);
  if (!pixels) fail("the PNG picture is broken or cut off", "save it again");
  const std::size_t count =
      4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.pixels.assign(pixels.get(), pixels.get() + count);
  return image;
}

}  // namespace fuai
