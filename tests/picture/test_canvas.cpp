// Text and the PNG encoding; the PNG is read back by Cairo's own decoder.
// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>

#include <cmath>

#include "fuai/picture/canvas.h"
#include "picture/png_reader.h"

using namespace fuai;

namespace {

Image blank(int width, int height, std::uint8_t value = 255) {
  return {width, height, std::vector<std::uint8_t>(4 * static_cast<std::size_t>(width * height), value)};
}

Image with_text(const std::string& text) {
  Canvas canvas(blank(300, 60));
  TextStyle style;
  style.size = 20.0;
  draw_text(canvas.cairo(), text, 10.0, 30.0, {0.0, 0.5}, style);
  return canvas.take_image();
}

}  // namespace

TEST_SUITE("crosscheck") {
  TEST_CASE("another decoder reads the same pixels from the PNG") {
    Image image = blank(37, 21);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        image.at(x, y)[0] = static_cast<std::uint8_t>(7 * x);
        image.at(x, y)[1] = static_cast<std::uint8_t>(11 * y);
        image.at(x, y)[2] = static_cast<std::uint8_t>(x * y);
      }
    }
    CHECK(test::read_png(encode_png(image)).pixels == image.pixels);
    image.at(3, 4)[3] = 0;  // a transparent pixel
    CHECK(test::read_png(encode_png(image)).at(3, 4)[3] == 0);
  }
}

TEST_SUITE("unit") {
  TEST_CASE("an image goes through the canvas unchanged when nothing is drawn, up to rounding of alpha") {
    Image image = blank(20, 16);
    for (int i = 0; i < 320; ++i) {
      std::uint8_t* p = image.at(i % 20, i / 20);
      p[0] = static_cast<std::uint8_t>(i);
      p[3] = i < 160 ? 255 : 128;
    }
    const Image back = Canvas(image).take_image();
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 20; ++x) {
        CHECK(back.at(x, y)[3] == image.at(x, y)[3]);
        // With alpha 128 a step of the stored colour is 255/128 of a step of the straight one.
        const int allowed = image.at(x, y)[3] == 255 ? 0 : 1;
        CHECK(std::abs(back.at(x, y)[0] - image.at(x, y)[0]) <= allowed);
      }
    }
  }

  TEST_CASE("Latin, Japanese, Greek and raised digits each draw their own signs") {
    // A sign that no font has is drawn as the same box for every character.
    CHECK(with_text("曲").pixels != with_text("緯").pixels);
    CHECK(with_text("κ").pixels != with_text("λ").pixels);
    CHECK(with_text("⁻").pixels != with_text("⁴").pixels);
    CHECK(with_text("a").pixels != with_text("").pixels);
    CHECK(with_text("").pixels == blank(300, 60).pixels);
  }

  TEST_CASE("what is no UTF-8 becomes a question mark and spoils nothing") {
    CHECK(clean_utf8("bending 曲げ\n2") == "bending 曲げ\n2");
    CHECK(clean_utf8("a\xff"
                     "b") == "a?b");
    CHECK(clean_utf8("\xe6\x9b") == "??");       // cut off
    CHECK(clean_utf8("\xc0\xaf") == "??");       // overlong
    CHECK(clean_utf8("\xed\xa0\x80") == "???");  // surrogate
    CHECK(clean_utf8("tab\there") == "tab?here");
    CHECK(with_text("a\xff"
                    "b")
              .pixels == with_text("a?b").pixels);
  }

  TEST_CASE("long text is wrapped at blanks and between Japanese signs, and no line is too wide") {
    Canvas canvas(blank(300, 60));
    TextStyle style;
    style.size = 16.0;
    for (const char* text :
         {"one two three four five six seven eight", "曲げ剛性と曲げヒステリシス幅を測定した織物の例"}) {
      const std::string wrapped = wrap_text(canvas.cairo(), text, style, 120.0);
      CHECK(wrapped.find('\n') != std::string::npos);
      CHECK(measure_text(canvas.cairo(), wrapped, style).width <=
            120.0 + 16.0 * 0.3);  // a blank may hang over
      std::string joined;
      for (char c : wrapped) {
        if (c != '\n') joined += c;
      }
      CHECK(joined == text);
    }
    CHECK(wrap_text(canvas.cairo(), "short", style, 120.0) == "short");
  }
}
