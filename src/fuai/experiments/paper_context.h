// What the parts of the paper's page share: tasks that run side by side, renderer, page under construction,
// files.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fuai/experiments/paper_page.h"
#include "fuai/picture/image.h"
#include "fuai/picture/offscreen_renderer.h"
#include "fuai/picture/plot.h"
#include "fuai/solver/relaxation.h"

namespace fuai {

/// One independent computation of the page.
struct PaperTask {
  std::string name;
  std::function<void(const Progress&)> run;
};

/// Where the figures write, one after another, after all tasks have run.
struct PaperContext {
  OffscreenRenderer renderer;
  HtmlPage page;
  PaperPage result;

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
};

/// One figure: names its tasks first, writes when they are done. The tasks fill the figure, so it must not
/// move.
class PaperFigure {
 public:
  PaperFigure() = default;
  PaperFigure(const PaperFigure&) = delete;
  PaperFigure& operator=(const PaperFigure&) = delete;
  virtual ~PaperFigure() = default;
  virtual std::vector<PaperTask> tasks() = 0;
  virtual void write(PaperContext& context) = 0;
};

std::unique_ptr<PaperFigure> make_figure_1();
std::unique_ptr<PaperFigure> make_figure_4();
std::unique_ptr<PaperFigure> make_figure_6();
/// Figure 7 or 8: curvature against force of one fabric. @param stands_for the paper's bending characteristic
std::unique_ptr<PaperFigure> make_force_figure(const std::string& number, const std::string& fabric_id,
                                               const std::string& stands_for);
/// What the engine's figures run; the defaults are those of the page.
struct EngineFigureOptions {
  std::vector<std::string> drapes{"graded-1", "graded-3", "graded-6", "graded-10"};  ///< fabrics
  std::vector<std::string> strips{"wool-tropical", "polyester-faille"};              ///< fabrics
  /// Arc curvatures of the strips [1/m]: out to a half turn and back, as in Figures 7 and 8 in wider steps.
  std::vector<double> curvatures{4.0, 8.0, 12.0, 16.0, 20.0, 16.0, 12.0, 8.0, 4.0};
};
/// Figure 4, and Figures 6 to 8, on the cloth engine: the third form.
std::unique_ptr<PaperFigure> make_engine_drapes(const EngineFigureOptions& options = {});
std::unique_ptr<PaperFigure> make_engine_strips(const EngineFigureOptions& options = {});
/// Not in the paper: the laws driven through the measured nested cycles.
std::unique_ptr<PaperFigure> make_measured_cycles();

/// Seconds since construction.
class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
  }

 private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

/// printf of one number into a string, for tables.
std::string text_of(const char* format, double value);

/// "as printed", "corrected".
constexpr const char* mode_name(PaperMode mode) {
  return mode == PaperMode::kAsPrinted ? "as printed" : "corrected";
}

}  // namespace fuai
