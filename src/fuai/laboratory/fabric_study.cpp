// Examines a fabric.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_study.h"

#include <algorithm>
#include <cmath>

#include "fuai/io/number_text.h"
#include "fuai/laboratory/drape_files.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

std::string percent(double fraction) { return fixed_number(100.0 * fraction, 1); }

std::string centimetres(double length) { return shown_number(length / unit::kCentimetre) + " cm"; }

/// The image on white, as wide as the other pictures.
Image widened(const Image& image, int width) {
  Image wide;
  wide.width = width, wide.height = image.height;
  wide.pixels.assign(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(image.height), 255);
  const int left = (width - image.width) / 2;
  for (int y = 0; y < image.height; ++y)
    std::copy_n(image.at(0, y), 4 * static_cast<std::size_t>(image.width), wide.at(left, y));
  return wide;
}

}  // namespace

FabricStudy run_fabric_study(const Fabric& fabric, const DrapeTestOptions& options,
                             const Progress& progress) {
  FabricStudy study;
  study.fabric = fabric;
  study.laws = make_fabric_laws(fabric);
  study.numbers = fabric_numbers(fabric, study.laws);
  study.drape = run_drape_test(study.laws, options, progress);
  return study;
}

StudyPictures draw_study(const FabricStudy& study, OffscreenRenderer& renderer) {
  constexpr int kWidth = 880, kHeight = 660;  // [pixel]
  const DrapeSample& sample = study.drape.typical();
  StudyPictures pictures;
  pictures.side = renderer.render(drape_picture(study.drape, sample, {}, false), kWidth, kHeight);
  pictures.top = renderer.render(drape_picture(study.drape, sample, {}, true), kWidth, kHeight);
  const Image shadow = shadow_image(study.drape.options.geometry, sample.run.shadow);
  pictures.shadow = widened(shadow, shadow.height * kWidth / kHeight);
  return pictures;
}

std::string drape_in_words(const DrapeTest& test) {
  std::string text = "drape coefficient " + percent(test.coefficient.mean);
  const std::size_t count = test.samples.size();
  if (count > 1) text += " ± " + percent(test.coefficient.deviation);
  text += " % (" + std::to_string(count) + (count > 1 ? " specimens), " : " specimen), ") +
          fixed_number(test.nodes.mean, 1) + " nodes";
  if (!test.bands.empty())
    text += "; " + percent(test.band_low) + " to " + percent(test.band_high) + " % with what was assumed";
  if (!test.at_rest()) text += "; NOT AT REST";
  return text;
}

std::string drape_setting_in_words(const DrapeTest& test) {
  const DrapeGeometry& g = test.options.geometry;
  const std::uint64_t first = test.samples.front().seed, last = test.samples.back().seed;
  return "disc " + centimetres(g.disc) + ", specimen " + centimetres(g.specimen) + ", spacing " +
         shown_number(g.spacing / unit::kMillimetre) + " mm, " +
         (first == last ? "seed " : "seeds " + std::to_string(first) + " to ") + std::to_string(last) +
         (test.options.elastic ? ", without friction" : "");
}

std::string measured_drape_in_words(const Fabric& fabric) {
  const DrapeMeasurement& d = fabric.drape;
  if (!d.drape_coefficient.has_value()) return {};
  std::string text = "measured: " + percent(d.drape_coefficient.value) + " %";
  if (d.node_count.has_value()) text += ", " + shown_number(d.node_count.value) + " nodes";
  const bool stated = d.disc_diameter.has_value() && d.specimen_diameter.has_value();
  return text + (stated ? " (disc " + centimetres(d.disc_diameter.value) + ", specimen " +
                              centimetres(d.specimen_diameter.value) + ")"
                        : " (tester not stated)");
}

std::string short_name(const Fabric& fabric) {
  constexpr std::size_t kMost = 26;  // characters
  const auto starts = [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; };
  const auto length = [&](const std::string& text) {
    return static_cast<std::size_t>(std::ranges::count_if(text, starts));
  };
  if (length(fabric.name) <= kMost) return fabric.name;
  const std::string& text = fabric.id.empty() ? fabric.name : fabric.id;
  std::string cut;
  std::size_t used = 0;
  for (const char c : text) {
    if (starts(c) && ++used > kMost) return cut + "…";
    cut += c;
  }
  return cut;
}

std::string shown_number(double value) { return std::isnan(value) ? "-" : brief_number(value, 4); }

}  // namespace fuai
