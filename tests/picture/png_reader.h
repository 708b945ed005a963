// Reads PNG bytes with Cairo's decoder, and counts pixels.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo/cairo.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <string>

#include "fuai/picture/colour_map.h"
#include "fuai/picture/image.h"

namespace fuai::test {

inline Image read_png(const std::string& bytes) {
  struct Source {
    const std::string& bytes;
    std::size_t at = 0;
  } source{bytes};
  const auto read = [](void* closure, unsigned char* data, unsigned int length) {
    auto& from = *static_cast<Source*>(closure);
    if (from.at + length > from.bytes.size()) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(data, from.bytes.data() + from.at, length);
    from.at += length;
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(read, &source);
  Image image;
  image.width = cairo_image_surface_get_width(surface);
  image.height = cairo_image_surface_get_height(surface);
  image.pixels.resize(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const bool opaque = cairo_image_surface_get_format(surface) == CAIRO_FORMAT_RGB24;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      std::uint32_t word = 0;
      std::memcpy(&word,
                  cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x,
                  4);
      std::uint8_t* p = image.at(x, y);
      p[0] = static_cast<std::uint8_t>(word >> 16);
      p[1] = static_cast<std::uint8_t>(word >> 8);
      p[2] = static_cast<std::uint8_t>(word);
      p[3] = opaque ? 255 : static_cast<std::uint8_t>(word >> 24);
    }
  }
  cairo_surface_destroy(surface);
  return image;
}

/// Number of pixels for which the test holds.
inline int count_pixels(const Image& image, const std::function<bool(const std::uint8_t*)>& test) {
  int count = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) count += test(image.at(x, y)) ? 1 : 0;
  }
  return count;
}

/// Whether a pixel is within `tolerance` steps of a colour in every channel.
inline bool is_near(const std::uint8_t* pixel, const Colour& colour, int tolerance) {
  return std::abs(pixel[0] - 255.0 * colour.red) <= tolerance &&
         std::abs(pixel[1] - 255.0 * colour.green) <= tolerance &&
         std::abs(pixel[2] - 255.0 * colour.blue) <= tolerance;
}

}  // namespace fuai::test
