// A Cairo surface over an image or an SVG, and text on it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cairo/cairo.h>

#include <memory>
#include <string>
#include <string_view>

#include "fuai/picture/colour_map.h"
#include "fuai/picture/image.h"

namespace fuai {

struct TextStyle {
  double size = 12.0;  ///< height of the letters' body [user unit]
  Colour colour{0.13, 0.13, 0.13, 1.0};
  bool bold = false;
  double halo = 0.0;  ///< width of the outline in `halo_colour` [user unit]; 0: none
  Colour halo_colour{1.0, 1.0, 1.0, 0.85};
};

/// Where a text is fastened: 0 left or top, 0.5 middle, 1 right or bottom.
struct Anchor {
  double x = 0.0;
  double y = 0.0;
};

struct TextBox {
  double width = 0.0;
  double height = 0.0;
};

/// Cairo's surface and context. Thread class: set-up.
class Canvas {
 public:
  /// Draws over a copy of an image.
  explicit Canvas(const Image& image);
  /// Records an SVG. @param width, height [pt]
  Canvas(double width, double height);
  ~Canvas();
  Canvas(Canvas&&) = delete;
  Canvas& operator=(Canvas&&) = delete;

  cairo_t* cairo() const { return context_; }
  cairo_surface_t* surface() const { return surface_; }
  /// What was drawn. Throw Error kCheckFailed with Cairo's message when something went wrong.
  Image take_image();
  std::string take_svg();

 private:
  void check() const;
  cairo_surface_t* surface_ = nullptr;
  cairo_t* context_ = nullptr;
  std::string svg_;
};

void set_colour(cairo_t* cairo, const Colour& colour);

/// Draws an image over a rectangle, stretched to it. @param left, top, width, height [user unit]
void draw_image(cairo_t* cairo, const Image& image, double left, double top, double width, double height);

/// Size of a text; "\n" starts a line.
TextBox measure_text(cairo_t* cairo, std::string_view text, const TextStyle& style);

/// Draws UTF-8 text; bytes that are no UTF-8 and control characters become "?".
/// @param angle [rad] clockwise about the anchor
void draw_text(cairo_t* cairo, std::string_view text, double x, double y, Anchor anchor,
               const TextStyle& style, double angle = 0.0);

/// Puts line ends into a text so that no line is wider than `width`: at blanks, and between any two Chinese
/// or Japanese characters.
std::string wrap_text(cairo_t* cairo, std::string_view text, const TextStyle& style, double width);

/// The text with "?" for whatever is not UTF-8 or is a control character other than a line end.
std::string clean_utf8(std::string_view text);

}  // namespace fuai
