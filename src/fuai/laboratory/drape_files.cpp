// Draws and tabulates a drape test.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/drape_files.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <utility>

#include "fuai/cloth/piece_mesh.h"
#include "fuai/io/mesh_obj.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/units/constants.h"

namespace fuai {
namespace {

constexpr int kPictureWidth = 1000, kPictureHeight = 750;  // [pixel]
constexpr double kTurn = 2.0 * std::numbers::pi;

template <class... Numbers>
std::string text_of(const char* format, Numbers... numbers) {
  char text[160];
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wformat-nonliteral"
  std::snprintf(text, sizeof text, format, numbers...);
#pragma GCC diagnostic pop
  return text;
}

double millimetres(double length) { return length / unit::kMillimetre; }

std::string circle(double radius, const char* style) {
  return text_of("<circle r=\"%.3f\" ", millimetres(radius)) + style + "/>\n";
}

/// Pixels of the shadow's picture.
struct Shade {
  std::uint8_t red, green, blue;
};
constexpr Shade kPaper{255, 255, 255}, kShadow{120, 124, 134}, kDisc{178, 181, 188}, kRim{196, 92, 40},
    kCrest{196, 30, 60};

/// Whether a circle of this radius passes through the pixel at this distance from the middle.
bool on_circle(double distance, double radius, double width) {
  return std::abs(distance - radius) < 0.5 * width;
}

std::string caption_of(const DrapeTest& test, const DrapeSample& sample, const std::string& fabric) {
  const DrapeGeometry& g = test.options.geometry;
  std::string text = fabric + text_of("\ndisc %.4g cm, specimen %.4g cm", g.disc / unit::kCentimetre,
                                      g.specimen / unit::kCentimetre);
  text += text_of("\ndrape coefficient %.1f %%, %d nodes", 100.0 * sample.run.shadow.coefficient,
                  static_cast<int>(sample.run.shadow.nodes.size()));
  if (test.samples.size() > 1) {
    text += text_of("\nmean of %d specimens %.1f %%", static_cast<int>(test.samples.size()),
                    100.0 * test.coefficient.mean);
  }
  return text;
}

SurfaceMesh mesh_of(const DrapeTest& test, const DrapeSample& sample) {
  // Unperturbed mass: the mesh knows only places.
  DrapePerturbation perturbation = test.options.perturbation;
  perturbation.density = 0.0;
  const ClothModel model = make_drape_model(test.options.geometry, 1.0, sample.seed, perturbation);
  return make_piece_mesh(model, sample.run.state.positions).mesh;
}

}  // namespace

std::string shadow_svg(const DrapeGeometry& geometry, const DrapeShadow& shadow, const std::string& title) {
  const double half = millimetres(0.5 * geometry.specimen) + 12.0;
  std::string svg = text_of(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0fmm\" height=\"%.0fmm\" viewBox=\"%.3f %.3f %.3f "
      "%.3f\">\n",
      2.0 * half, 2.0 * half, -half, -half, 2.0 * half, 2.0 * half);
  svg += "<title>" + escape_html(title) + "</title>\n<rect x=\"" + text_of("%.3f", -half) + "\" y=\"" +
         text_of("%.3f", -half) + "\" width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
  svg += "<path fill=\"#787c86\" d=\"M";
  for (std::size_t i = 0; i < shadow.outline.size(); ++i) {
    const double angle = kTurn * static_cast<double>(i) / static_cast<double>(shadow.outline.size());
    const double radius = millimetres(shadow.outline[i]);
    svg += text_of("%s%.3f,%.3f", i == 0 ? "" : " ", radius * std::cos(angle), -radius * std::sin(angle));
  }
  svg += "Z\"/>\n" + circle(0.5 * geometry.disc, "fill=\"#b2b5bc\"");
  svg += circle(0.5 * geometry.specimen, "fill=\"none\" stroke=\"#c45c28\" stroke-width=\"0.6\"");
  for (const DrapeNode& node : shadow.nodes) {
    const double radius = millimetres(node.radius);
    svg += text_of("<circle cx=\"%.3f\" cy=\"%.3f\" r=\"1.6\" fill=\"#c41e3c\"/>\n",
                   radius * std::cos(node.azimuth), -radius * std::sin(node.azimuth));
  }
  svg +=
      text_of("<text x=\"0\" y=\"%.3f\" font-family=\"sans-serif\" font-size=\"5\" text-anchor=\"middle\">",
              half - 3.0);
  return svg + escape_html(title) + "</text>\n</svg>\n";
}

Image shadow_image(const DrapeGeometry& geometry, const DrapeShadow& shadow) {
  constexpr int kScale = 2;
  const int margin = 8, reach = shadow.side / 2 + margin, side = 2 * kScale * reach;
  const double pixel = kShadowPixel / kScale;
  Image image;
  image.width = image.height = side;
  image.pixels.assign(4 * static_cast<std::size_t>(side) * static_cast<std::size_t>(side), 255);
  const int middle = side / 2;
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const Vec2 place = pixel * Vec2(x - middle + 0.5, middle - y - 0.5);
      const int column = x / kScale - margin, row = y / kScale - margin;
      const bool inside = column >= 0 && column < shadow.side && row >= 0 && row < shadow.side;
      const auto cell = static_cast<std::ptrdiff_t>(row) * shadow.side + column;
      const bool dark = inside && shadow.raster[static_cast<std::size_t>(cell)] != 0;
      Shade shade = dark ? kShadow : kPaper;
      if (place.norm() < 0.5 * geometry.disc) shade = kDisc;
      if (on_circle(place.norm(), 0.5 * geometry.specimen, 3.0 * pixel)) shade = kRim;
      for (const DrapeNode& node : shadow.nodes) {
        const Vec2 crest = node.radius * Vec2(std::cos(node.azimuth), std::sin(node.azimuth));
        if ((place - crest).norm() < 8.0 * pixel) shade = kCrest;
      }
      std::uint8_t* at = image.at(x, y);
      at[0] = shade.red;
      at[1] = shade.green;
      at[2] = shade.blue;
    }
  }
  return image;
}

ClothPicture drape_picture(const DrapeTest& test, const DrapeSample& sample, const std::string& caption,
                           bool from_above) {
  const DrapeGeometry& g = test.options.geometry;
  ClothPicture picture;
  ClothItem cloth;
  cloth.mesh = mesh_of(test, sample);
  cloth.thread_spacing = std::max(g.spacing, 0.005);
  CylinderItem disc, stem;
  disc.radius = 0.5 * g.disc;
  disc.top = Vec3(0.0, 0.0, -0.001);  // below the cloth, so that they do not flicker
  disc.height = 0.008;
  stem.radius = 0.3 * disc.radius;
  stem.top = disc.top - Vec3(0.0, 0.0, disc.height);
  stem.height = 1.3 * g.overhang();
  picture.cylinders = {disc, stem};
  picture.ground.height = stem.top.z() - stem.height;
  // The same frame for every fabric: the flat specimen, and cloth that hangs straight down.
  Bounds bounds;
  const double side = 0.45 * g.specimen;
  bounds.include(Vec3(-side, -side, picture.ground.height));
  bounds.include(Vec3(side, side, 0.0));
  const double aspect = static_cast<double>(kPictureWidth) / kPictureHeight;
  const double elevation = (from_above ? 90.0 : 16.0) * unit::kDegree;
  picture.camera = frame_camera(bounds, -90.0 * unit::kDegree, elevation, aspect);
  if (from_above) picture.camera.parallel_height = 1.15 * g.specimen;
  picture.caption = caption;
  picture.cloths.push_back(std::move(cloth));
  return picture;
}

HtmlTable specimen_table(const DrapeTest& test) {
  HtmlTable table;
  table.caption = "specimens";
  table.header = {"seed",     "drape_coefficient_percent",
                  "nodes",    "node_amplitude_mm",
                  "residual", "seconds",
                  "steps",    "cpu_seconds",
                  "at_rest"};
  for (const DrapeSample& sample : test.samples) {
    const DrapeRun& run = sample.run;
    table.rows.push_back(
        {std::to_string(sample.seed), text_of("%.3f", 100.0 * run.shadow.coefficient),
         std::to_string(run.shadow.nodes.size()), text_of("%.2f", millimetres(run.shadow.mean_amplitude())),
         text_of("%.2e", run.residual), text_of("%.3f", run.seconds), std::to_string(run.steps),
         text_of("%.2f", sample.cpu_seconds), run.at_rest ? "yes" : "no"});
  }
  return table;
}

HtmlTable convergence_table(const DrapeConvergence& convergence) {
  HtmlTable table;
  table.caption = "convergence";
  table.header = {"spacing_mm",   "mean_percent", "std_points", "least_percent",
                  "most_percent", "nodes",        "cap_N_per_m"};
  for (const DrapeTest& test : convergence.tests) {
    const double cap = std::min(test.locking[0].factor * test.locking[0].stiffness,
                                test.locking[1].factor * test.locking[1].stiffness);
    table.rows.push_back(
        {text_of("%.4g", millimetres(test.options.geometry.spacing)),
         text_of("%.2f", 100.0 * test.coefficient.mean), text_of("%.2f", 100.0 * test.coefficient.deviation),
         text_of("%.2f", 100.0 * test.coefficient.low), text_of("%.2f", 100.0 * test.coefficient.high),
         text_of("%.1f", test.nodes.mean), text_of("%.0f", cap)});
  }
  return table;
}

Plot convergence_plot(const DrapeConvergence& convergence, const std::string& title) {
  Plot plot;
  plot.title = title;
  plot.x_label = "spacing [mm]";
  plot.y_label = "drape coefficient [%]";
  Series means, all;
  means.label = "mean";
  means.style = SeriesStyle::kLineAndPoints;
  all.label = "specimens";
  all.style = SeriesStyle::kPoints;
  for (const DrapeTest& test : convergence.tests) {
    const double spacing = millimetres(test.options.geometry.spacing);
    means.x.push_back(spacing);
    means.y.push_back(100.0 * test.coefficient.mean);
    for (const double each : test.coefficient.each) {
      all.x.push_back(spacing);
      all.y.push_back(100.0 * each);
    }
  }
  plot.series = {std::move(means), std::move(all)};
  return plot;
}

std::vector<OutputFile> drape_files(const DrapeTest& test, const DrapeConvergence& convergence,
                                    const std::string& fabric_name) {
  const DrapeSample& sample = test.typical();
  const DrapeGeometry& g = test.options.geometry;
  std::vector<OutputFile> files;
  const std::string title =
      fabric_name + text_of(": drape coefficient %.1f %%, %d nodes", 100.0 * sample.run.shadow.coefficient,
                            static_cast<int>(sample.run.shadow.nodes.size()));
  files.push_back({"shadow.svg", shadow_svg(g, sample.run.shadow, title)});
  files.push_back({"mesh.obj", mesh_obj(mesh_of(test, sample), fabric_name)});
  files.push_back({"specimens.csv", to_csv(specimen_table(test))});
  HtmlTable outline;
  outline.header = {"azimuth_deg", "radius_mm"};
  for (std::size_t i = 0; i < sample.run.shadow.outline.size(); ++i) {
    outline.rows.push_back({text_of("%.4g", 360.0 * static_cast<double>(i) / kShadowDirections),
                            text_of("%.3f", millimetres(sample.run.shadow.outline[i]))});
  }
  files.push_back({"outline.csv", to_csv(outline)});
  if (!convergence.tests.empty())
    files.push_back({"convergence.csv", to_csv(convergence_table(convergence))});
  return files;
}

std::vector<OutputFile> drape_pictures(const DrapeTest& test, const DrapeConvergence& convergence,
                                       const std::string& fabric_name) {
  const DrapeSample& sample = test.typical();
  OffscreenRenderer renderer = make_offscreen_renderer();
  const std::string caption = caption_of(test, sample, fabric_name);
  const auto view = [&](bool from_above) {
    return encode_png(
        renderer.render(drape_picture(test, sample, caption, from_above), kPictureWidth, kPictureHeight));
  };
  std::vector<OutputFile> files;
  files.push_back({"shadow.png", encode_png(shadow_image(test.options.geometry, sample.run.shadow))});
  files.push_back({"top.png", view(true)});
  files.push_back({"side.png", view(false)});
  if (convergence.tests.empty()) return files;
  const Plot plot = convergence_plot(convergence, fabric_name);
  files.push_back({"convergence.png", plot_png(plot, 480, 360)});
  files.push_back({"convergence.svg", plot_svg(plot, 480, 360)});
  return files;
}

}  // namespace fuai
