// Draws caption, colour bar, labels, triad and grid size with Cairo.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/overlay.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

#include "fuai/picture/canvas.h"
#include "fuai/picture/plot_axis.h"

namespace fuai {
namespace {

/// Drawing surface and the measures all parts share.
struct Sheet {
  cairo_t* cairo;
  double width, height;
  double margin;    // to the border of the picture [pixel]
  TextStyle plain;  // letter size in proportion to the picture
  double right;     // end of the part that no colour bar takes [pixel]
  double top;       // end of the caption [pixel]
  bool dark;        // background
};

/// A colour for letters: darker on a light background, lighter on a dark one.
Colour ink(const Sheet& sheet, const Colour& c) {
  const double keep = sheet.dark ? 0.55 : 0.85, add = sheet.dark ? 0.45 : 0.0;
  return {keep * c.red + add, keep * c.green + add, keep * c.blue + add, 1.0};
}

void draw_caption(Sheet& sheet, const std::string& caption) {
  TextStyle style = sheet.plain;
  style.size *= 1.15;
  const std::string text = wrap_text(sheet.cairo, caption, style, sheet.right - 2.0 * sheet.margin);
  draw_text(sheet.cairo, text, sheet.margin, 0.6 * sheet.margin, {0.0, 0.0}, style);
  sheet.top = 0.6 * sheet.margin + measure_text(sheet.cairo, text, style).height;
}

void draw_colour_bar(const Sheet& sheet, const ColourBar& bar) {
  cairo_t* cairo = sheet.cairo;
  const double strip = kColourBarStrip * sheet.width, size = sheet.plain.size;
  const double left = sheet.width - strip + 0.5 * size, bar_width = 1.2 * size;
  const double top = 0.26 * sheet.height, bottom = 0.84 * sheet.height;
  // The field of colours, a line a pixel.
  cairo_pattern_t* pattern = cairo_pattern_create_linear(0.0, bottom, 0.0, top);
  for (int i = 0; i <= 64; ++i) {
    const Colour c = sample_colour_map(bar.map, i / 64.0);
    cairo_pattern_add_color_stop_rgb(pattern, i / 64.0, c.red, c.green, c.blue);
  }
  cairo_rectangle(cairo, left, top, bar_width, bottom - top);
  cairo_set_source(cairo, pattern);
  cairo_fill_preserve(cairo);
  cairo_pattern_destroy(pattern);
  set_colour(cairo, sheet.plain.colour);
  cairo_set_line_width(cairo, 1.0);
  cairo_stroke(cairo);
  // Ticks, numbers and the title above.
  const Axis axis = make_axis(bar.low, bar.high, false, 7);
  for (const Tick& tick : axis.ticks) {
    const double y = bottom + (top - bottom) * axis.place(tick.value);
    cairo_move_to(cairo, left + bar_width, y);
    cairo_line_to(cairo, left + bar_width + 0.3 * size, y);
    set_colour(cairo, sheet.plain.colour);
    cairo_stroke(cairo);
    draw_text(cairo, tick.label, left + bar_width + 0.5 * size, y, {0.0, 0.5}, sheet.plain);
  }
  std::string title = wrap_text(cairo, bar.title, sheet.plain, strip - size);
  if (!axis.factor.empty()) title += "\n" + axis.factor;
  draw_text(cairo, title, left, top - 0.5 * size, {0.0, 1.0}, sheet.plain);
}

void draw_arrow_label(const Sheet& sheet, const ClothPicture& picture, const ArrowItem& arrow) {
  if (arrow.label.empty()) return;
  const int w = static_cast<int>(sheet.width), h = static_cast<int>(sheet.height);
  const Vec3 tip = project_to_pixel(picture.camera, w, h, arrow.origin + arrow.vector);
  const Vec3 root = project_to_pixel(picture.camera, w, h, arrow.origin);
  if (tip.z() <= 0.0) return;  // behind the eye
  TextStyle style = sheet.plain;
  style.colour = ink(sheet, arrow.colour);
  style.bold = true;
  const TextBox box = measure_text(sheet.cairo, arrow.label, style);
  // Beyond the tip, in the direction in which the arrow points on the picture.
  Vec2 ahead = (tip - root).head<2>();
  ahead = ahead.norm() > 1.0 ? Vec2(ahead.normalized()) : Vec2(0.0, -1.0);
  const double x = tip.x() + ahead.x() * (0.5 * box.width + 0.6 * style.size);
  const double y = tip.y() + ahead.y() * (0.5 * box.height + 0.3 * style.size);
  const double half_width = 0.5 * box.width + 0.4 * sheet.margin;
  const double half_height = 0.5 * box.height + 0.2 * sheet.margin;
  draw_text(
      sheet.cairo, arrow.label, std::clamp(x, half_width, std::max(half_width, sheet.right - half_width)),
      std::clamp(y, sheet.top + half_height, std::max(sheet.top + half_height, sheet.height - half_height)),
      {0.5, 0.5}, style);
}

/// Mean directions of weft and warp: the area-weighted mean of d position / d material over the triangles.
Eigen::Matrix<double, 3, 2> mean_yarn_directions(const SurfaceMesh& mesh) {
  Eigen::Matrix<double, 3, 2> sum = Eigen::Matrix<double, 3, 2>::Zero();
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b),
               k = static_cast<std::size_t>(c);
    Eigen::Matrix<double, 3, 2> edges;
    edges << mesh.positions[j] - mesh.positions[i], mesh.positions[k] - mesh.positions[i];
    Eigen::Matrix2d flat;
    flat << mesh.material[j] - mesh.material[i], mesh.material[k] - mesh.material[i];
    // edges = F flat, and |det flat| is twice the area: det * F = edges * adjugate(flat).
    const double det = flat.determinant();
    Eigen::Matrix2d adjugate;
    adjugate << flat(1, 1), -flat(0, 1), -flat(1, 0), flat(0, 0);
    sum += (det < 0.0 ? -1.0 : 1.0) * edges * adjugate;
  }
  return sum;
}

void draw_triad(const Sheet& sheet, const ClothPicture& picture) {
  struct Ray {
    Vec2 flat;  // on the picture, y downward
    Colour colour;
    std::string label;
  };
  const Mat3 to_camera = camera_axes(picture.camera).transpose();
  std::vector<Ray> rays;
  const auto add = [&](const Vec3& direction, Colour colour, const std::string& label) {
    const Vec3 q = to_camera * direction;
    const Vec2 flat(q.x(), -q.y());
    if (flat.norm() > 0.12)
      rays.push_back({flat, colour, label});  // else it points at the viewer or is not known
  };
  if (!picture.cloths.empty()) {
    const auto yarns = mean_yarn_directions(picture.cloths.front().mesh);
    add(yarns.col(0).normalized(), yarn_colour(Direction::kWeft), picture.triad.weft_label);
    add(yarns.col(1).normalized(), yarn_colour(Direction::kWarp), picture.triad.warp_label);
  }
  // Up is left out where it would hide a yarn.
  const Vec2 up(to_camera(0, 2), -to_camera(1, 2));
  const bool hides = std::any_of(rays.begin(), rays.end(), [&](const Ray& ray) {
    return ray.flat.dot(up) > 0.94 * ray.flat.norm() * up.norm();
  });
  if (!hides) add(Vec3::UnitZ(), sheet.plain.colour, picture.triad.up_label);

  cairo_t* cairo = sheet.cairo;
  const double size = sheet.plain.size, length = 2.6 * size, head = 0.55 * size;
  const Vec2 origin(sheet.margin + 1.9 * length, sheet.height - sheet.margin - 1.9 * length);
  std::vector<Vec2> places;
  for (const Ray& ray : rays) {
    const Vec2 ahead = ray.flat.normalized(), aside(-ahead.y(), ahead.x());
    const Vec2 tip = origin + length * ray.flat, neck = tip - head * ahead;
    set_colour(cairo, ray.colour);
    cairo_set_line_width(cairo, 0.16 * size);
    cairo_move_to(cairo, origin.x(), origin.y());
    cairo_line_to(cairo, neck.x(), neck.y());
    cairo_stroke(cairo);
    const Vec2 left = neck + 0.4 * head * aside, right = neck - 0.4 * head * aside;
    cairo_move_to(cairo, tip.x(), tip.y());
    cairo_line_to(cairo, left.x(), left.y());
    cairo_line_to(cairo, right.x(), right.y());
    cairo_close_path(cairo);
    cairo_fill(cairo);
    TextStyle style = sheet.plain;
    style.colour = ink(sheet, ray.colour);
    // A label beyond the tip; one that would lie on another goes a line on, up or down as its arrow points.
    Vec2 place = tip + 0.35 * size * ahead;
    for (const Vec2& other : places) {
      if (std::abs(place.x() - other.x()) < 3.0 * size && std::abs(place.y() - other.y()) < 1.2 * size)
        place.y() = other.y() + (ahead.y() < -0.7 ? -1.3 : 1.3) * size;
    }
    places.push_back(place);
    draw_text(cairo, ray.label, place.x(), place.y(), {0.5 - 0.5 * ahead.x(), 0.5 - 0.5 * ahead.y()}, style);
  }
}

void draw_grid_size(const Sheet& sheet, double grid) {
  const double size = sheet.plain.size, side = 0.75 * size;
  const std::string text = format_number(100.0 * grid) + " cm";
  const double y = sheet.height - 0.8 * sheet.margin - 0.5 * size;
  const double x = sheet.width - sheet.margin - measure_text(sheet.cairo, text, sheet.plain).width;
  draw_text(sheet.cairo, text, x, y, {0.0, 0.5}, sheet.plain);
  cairo_rectangle(sheet.cairo, x - 1.5 * side, y - 0.5 * side, side, side);
  set_colour(sheet.cairo, sheet.plain.colour);
  cairo_set_line_width(sheet.cairo, 1.0);
  cairo_stroke(sheet.cairo);
}

}  // namespace

Image draw_overlay(const Image& image, const ClothPicture& picture) {
  Canvas canvas(image);
  Sheet sheet{
      canvas.cairo(), static_cast<double>(image.width), static_cast<double>(image.height), 0.0, {}, 0.0, 0.0,
      false};
  sheet.plain.size = std::max(9.0, 0.026 * std::min(sheet.height, 0.8 * sheet.width));
  sheet.margin = sheet.plain.size;
  sheet.right = sheet.width * (picture.colour_bar ? 1.0 - kColourBarStrip : 1.0);
  sheet.plain.halo = 0.16 * sheet.plain.size;
  // Dark letters on a light background, light ones on a dark background.
  const Colour& back = picture.background;
  const double lightness = 0.3 * back.red + 0.6 * back.green + 0.1 * back.blue;
  sheet.dark = back.alpha > 0.5 && lightness < 0.45;
  if (sheet.dark) {
    sheet.plain.colour = {0.93, 0.93, 0.93, 1.0};
    sheet.plain.halo_colour = {0.0, 0.0, 0.0, 0.6};
  }
  if (!picture.caption.empty()) draw_caption(sheet, picture.caption);
  if (picture.colour_bar) draw_colour_bar(sheet, *picture.colour_bar);
  if (picture.triad.shown) draw_triad(sheet, picture);
  if (picture.ground.shown && picture.ground.grid > 0.0) draw_grid_size(sheet, picture.ground.grid);
  for (const ArrowItem& arrow : picture.arrows) draw_arrow_label(sheet, picture, arrow);
  return canvas.take_image();
}

}  // namespace fuai
