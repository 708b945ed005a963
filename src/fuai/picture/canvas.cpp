// Surfaces, text and its measures with Cairo's simple text interface; fontconfig finds the fonts.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/canvas.h"

#include <cairo/cairo-svg.h>

#include <algorithm>
#include <map>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/core/hash.h"

namespace fuai {
namespace {

constexpr const char* kFont = "Noto Sans CJK JP";
constexpr const char* kSecondFont = "DejaVu Sans";  // for what the first has not, e.g. raised digits
constexpr double kLineHeight = 1.35;                // in letter sizes
constexpr double kCapHeight = 0.73;                 // height of capitals in letter sizes, of the font above

void set_font(cairo_t* cairo, const char* family, const TextStyle& style) {
  cairo_select_font_face(cairo, family, CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cairo, style.size);
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines(1);
  for (char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else {
      lines.back() += c;
    }
  }
  return lines;
}

/// Length of the UTF-8 sequence that starts at text[0], 0 when it is malformed.
std::size_t sequence_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80   ? 1
                             : first < 0xC2 ? 0
                             : first < 0xE0 ? 2
                             : first < 0xF0 ? 3
                             : first < 0xF5 ? 4
                                            : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
  }
  if (length < 3) return length;
  // Overlong forms, surrogates and numbers above U+10FFFF.
  const unsigned char second = byte(1);
  const bool wrong = (first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                     (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F);
  return wrong ? 0 : length;
}

/// Part of a line that one font can write.
struct Run {
  const char* font;
  std::string text;
};

/// Whether the font that is set has a sign for the character.
bool has_glyph(cairo_t* cairo, const std::string& character) {
  cairo_glyph_t* glyphs = nullptr;
  int count = 0;
  const cairo_status_t status = cairo_scaled_font_text_to_glyphs(
      cairo_get_scaled_font(cairo), 0.0, 0.0, character.data(), static_cast<int>(character.size()), &glyphs,
      &count, nullptr, nullptr, nullptr);
  const bool found = status == CAIRO_STATUS_SUCCESS && count > 0 && glyphs[0].index != 0;
  cairo_glyph_free(glyphs);
  return found;
}

std::vector<Run> split_runs(cairo_t* cairo, const std::string& line, const TextStyle& style) {
  std::vector<Run> runs;
  set_font(cairo, kFont, style);
  for (std::size_t i = 0; i < line.size();) {
    const std::string character = line.substr(i, sequence_length(std::string_view(line).substr(i)));
    i += character.size();
    const bool plain = character.size() == 1 || has_glyph(cairo, character);
    const char* font = plain ? kFont : kSecondFont;
    if (runs.empty() || runs.back().font != font) runs.push_back({font, {}});
    runs.back().text += character;
  }
  return runs;
}

double line_width(cairo_t* cairo, const std::string& line, const TextStyle& style) {
  double width = 0.0;
  for (const Run& run : split_runs(cairo, line, style)) {
    cairo_text_extents_t extents;
    set_font(cairo, run.font, style);
    cairo_text_extents(cairo, run.text.c_str(), &extents);
    width += extents.x_advance;
  }
  return width;
}

/// Writes one line from (left, baseline) on.
void show_line(cairo_t* cairo, const std::string& line, double left, double baseline,
               const TextStyle& style) {
  const std::vector<Run> runs = split_runs(cairo, line, style);
  // First the outline of all, so that it covers no letter.
  if (style.halo > 0.0) {
    cairo_move_to(cairo, left, baseline);
    for (const Run& run : runs) {
      set_font(cairo, run.font, style);
      cairo_text_path(cairo, run.text.c_str());
    }
    set_colour(cairo, style.halo_colour);
    cairo_set_line_width(cairo, 2.0 * style.halo);
    cairo_set_line_join(cairo, CAIRO_LINE_JOIN_ROUND);
    cairo_stroke(cairo);
  }
  set_colour(cairo, style.colour);
  cairo_move_to(cairo, left, baseline);
  for (const Run& run : runs) {
    set_font(cairo, run.font, style);
    cairo_show_text(cairo, run.text.c_str());
  }
  cairo_new_path(cairo);
}

/// An SVG whose ids are its own: Cairo counts them through the process and begins again for each document's
/// letters, so that two documents on one page would take each other's letters. The new ids begin with a hash
/// of the document.
std::string with_own_ids(const std::string& svg) {
  std::vector<std::string> pieces(1);  // text, id, text, id, ..., text
  std::map<std::string, std::size_t> numbers;
  StateHash hash;
  for (std::size_t i = 0; i < svg.size();) {
    std::size_t begin = 0;
    for (const std::string_view mark : {"id=\"", "\"#", "(#"}) {
      if (svg.compare(i, mark.size(), mark) == 0) begin = mark.size();
    }
    pieces.back() += svg.substr(i, std::max<std::size_t>(begin, 1));
    i += std::max<std::size_t>(begin, 1);
    if (begin == 0) continue;
    const std::size_t end = std::min(svg.find_first_of("\")", i), svg.size());
    const auto number = numbers.emplace(svg.substr(i, end - i), numbers.size()).first->second;
    hash.add(pieces.back().data(), pieces.back().size());
    pieces.push_back(std::to_string(number));
    pieces.emplace_back();
    i = end;
  }
  hash.add(pieces.back().data(), pieces.back().size());
  std::string own;
  for (std::size_t k = 0; k < pieces.size(); ++k)
    own += k % 2 == 0 ? pieces[k] : "p" + hash.hex() + "-" + pieces[k];
  return own;
}

}  // namespace

std::string clean_utf8(std::string_view text) {
  std::string clean;
  while (!text.empty()) {
    const std::size_t length = sequence_length(text);
    const auto first = static_cast<unsigned char>(text[0]);
    const bool control = (first < 0x20 && first != '\n') || first == 0x7F;
    if (length == 0 || control) {
      clean += '?';
    } else {
      clean += text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return clean;
}

Canvas::Canvas(const Image& image)
    : surface_(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height)) {
  context_ = cairo_create(surface_);
  check();
  // Straight RGBA bytes to premultiplied ARGB words.
  unsigned char* data = cairo_image_surface_get_data(surface_);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_));
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::size_t>(y) * stride);
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = image.at(x, y);
      const std::uint32_t a = p[3];
      const auto times_alpha = [a](std::uint32_t part) { return (part * a + 127) / 255; };
      row[x] = (a << 24) | (times_alpha(p[0]) << 16) | (times_alpha(p[1]) << 8) | times_alpha(p[2]);
    }
  }
  cairo_surface_mark_dirty(surface_);
}

Canvas::Canvas(double width, double height) {
  const auto append = [](void* closure, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  surface_ = cairo_svg_surface_create_for_stream(append, &svg_, width, height);
  context_ = cairo_create(surface_);
  check();
}

Canvas::~Canvas() {
  cairo_destroy(context_);
  cairo_surface_destroy(surface_);
}

void Canvas::check() const {
  cairo_status_t status = cairo_status(context_);
  if (status == CAIRO_STATUS_SUCCESS) status = cairo_surface_status(surface_);
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(ErrorKind::kCheckFailed, std::string("drawing failed: ") + cairo_status_to_string(status));
}

Image Canvas::take_image() {
  cairo_surface_flush(surface_);
  check();
  Image image;
  image.width = cairo_image_surface_get_width(surface_);
  image.height = cairo_image_surface_get_height(surface_);
  image.pixels.resize(4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  const unsigned char* data = cairo_image_surface_get_data(surface_);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface_));
  for (int y = 0; y < image.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + static_cast<std::size_t>(y) * stride);
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t a = row[x] >> 24;
      const auto straight = [a](std::uint32_t part) {
        return static_cast<std::uint8_t>(a == 0 ? 0 : std::min<std::uint32_t>(255, (part * 255 + a / 2) / a));
      };
      std::uint8_t* p = image.at(x, y);
      p[0] = straight((row[x] >> 16) & 0xff);
      p[1] = straight((row[x] >> 8) & 0xff);
      p[2] = straight(row[x] & 0xff);
      p[3] = static_cast<std::uint8_t>(a);
    }
  }
  return image;
}

std::string Canvas::take_svg() {
  check();
  cairo_surface_finish(surface_);
  check();
  return with_own_ids(svg_);
}

void set_colour(cairo_t* cairo, const Colour& c) {
  cairo_set_source_rgba(cairo, c.red, c.green, c.blue, c.alpha);
}

void draw_image(cairo_t* cairo, const Image& image, double left, double top, double width, double height) {
  const Canvas pixels(image);
  cairo_save(cairo);
  cairo_translate(cairo, left, top);
  cairo_scale(cairo, width / image.width, height / image.height);
  cairo_set_source_surface(cairo, pixels.surface(), 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(cairo), CAIRO_FILTER_GOOD);
  cairo_paint(cairo);
  cairo_restore(cairo);
}

TextBox measure_text(cairo_t* cairo, std::string_view text, const TextStyle& style) {
  TextBox box;
  const std::vector<std::string> lines = split_lines(clean_utf8(text));
  for (const std::string& line : lines) box.width = std::max(box.width, line_width(cairo, line, style));
  box.height = kLineHeight * style.size * static_cast<double>(lines.size());
  return box;
}

void draw_text(cairo_t* cairo, std::string_view text, double x, double y, Anchor anchor,
               const TextStyle& style, double angle) {
  if (text.empty()) return;
  const TextBox box = measure_text(cairo, text, style);
  cairo_save(cairo);
  cairo_translate(cairo, x, y);
  cairo_rotate(cairo, angle);
  // The capitals of a line stand in the middle of its height.
  double baseline = -anchor.y * box.height + 0.5 * (kLineHeight + kCapHeight) * style.size;
  for (const std::string& line : split_lines(clean_utf8(text))) {
    show_line(cairo, line, -anchor.x * line_width(cairo, line, style), baseline, style);
    baseline += kLineHeight * style.size;
  }
  cairo_restore(cairo);
}

std::string wrap_text(cairo_t* cairo, std::string_view text, const TextStyle& style, double width) {
  std::string wrapped, line;
  // `line` may be broken at `breakable` (bytes), behind which the rest moves to the next line.
  std::size_t breakable = 0;
  const std::string clean = clean_utf8(text);
  for (std::size_t i = 0; i < clean.size();) {
    const std::size_t length = sequence_length(std::string_view(clean).substr(i));
    const std::string character = clean.substr(i, length);
    i += length;
    if (character == "\n") {
      wrapped += line + "\n";
      line.clear();
      breakable = 0;
      continue;
    }
    // Three bytes from U+2E80 on: Chinese and Japanese signs, before which a line may end.
    if (length >= 3 && character >= "\xE2\xBA\x80") breakable = line.size();
    line += character;
    if (line_width(cairo, line, style) > width && breakable > 0) {
      wrapped += line.substr(0, breakable) + "\n";
      line.erase(0, breakable);
      breakable = 0;
    }
    if (character == " ") breakable = line.size();
  }
  return wrapped + line;
}

}  // namespace fuai
