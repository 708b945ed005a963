// What the parts of the paper's page share: renderer, page under construction, files, progress.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <string>

#include "fuai/experiments/paper_page.h"
#include "fuai/picture/image.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// Handed from figure to figure.
struct PaperContext {
  OffscreenRenderer renderer;
  HtmlPage page;
  PaperPage result;
  const Progress& progress;
  double fraction = 0.0;  ///< of the whole page, before the running figure
  double share = 0.0;     ///< of the running figure

  void add_file(std::string name, std::string bytes) {
    result.files.push_back({std::move(name), std::move(bytes)});
  }
  void add_picture(const std::string& name, const ClothPicture& picture, int width, int height) {
    add_file(name, encode_png(renderer.render(picture, width, height)));
  }
  void add_plot(const std::string& stem, const PlotGrid& plot, int width, int height) {
    add_file(stem + ".png", plot_png(plot, width, height));
    add_file(stem + ".svg", plot_svg(plot, width, height));
  }
  /// A table on the page and as CSV beside it.
  void add_table(const std::string& csv_name, const HtmlTable& table) {
    page.table(table);
    add_file(csv_name, to_csv(table));
  }
  /// A progress function for part `index` of `count` equal parts of the running figure.
  Progress part(std::string what, int index, int count) const {
    if (!progress) return {};
    return [this, what = std::move(what), index, count](std::string_view, double done) {
      progress(what, fraction + share * (index + done) / count);
    };
  }
};

/// Seconds since construction.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// printf into a string, for tables.
std::string text_of(const char* format, double value);

void add_figure_1(PaperContext& context);
void add_figure_4(PaperContext& context);
void add_figure_6(PaperContext& context);
void add_figures_7_and_8(PaperContext& context, bool seven, bool eight);

}  // namespace fuai
