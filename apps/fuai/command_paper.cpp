// `fuai paper`.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/experiments/paper_page.h"
#include "fuai/io/text_file.h"

namespace fuai_app {
namespace {

using namespace fuai;

struct PaperOptions {
  std::string out = "out/paper";
  int figure = 0;  ///< 0: all; 1, 4, 6, 7 or 8
};

JsonValue run_json(const PaperSummaryRow& run) {
  JsonValue value;
  value.set("figure", run.figure).set("fabric", run.fabric).set("mode", run.mode);
  value.set("steps", std::int64_t{run.steps}).set("residual_node_weights", run.residual_node_weights);
  value.set("converged", run.converged).set("seconds", run.seconds);
  return value;
}

void print_run(const Console& console, const PaperSummaryRow& run) {
  char text[200];
  std::snprintf(text, sizeof text, "  figure %s  %-20s %-10s %10lld steps  residual %8.2g  %s  %6.1f s",
                run.figure.c_str(), run.fabric.c_str(), run.mode.c_str(), run.steps,
                run.residual_node_weights, run.converged ? "at rest    " : "not at rest", run.seconds);
  console.line(text);
}

int run_paper(const Console& console, const PaperOptions& options) {
  std::error_code code;
  std::filesystem::create_directories(options.out, code);
  if (code) {
    throw Error(ErrorKind::kBadInput, "cannot make the folder: " + code.message(), {options.out, 0, 0, ""},
                "name another folder with --out");
  }
  const std::string index = (std::filesystem::path(options.out) / "index.html").string();
  check_can_write(index);  // before the long run
  console.say("remaking the paper's figures; some minutes");
  const PaperPage page = make_paper_page({options.figure, console.options().threads}, console.progress());
  std::vector<NamedText> files;
  for (const OutputFile& file : page.files)
    files.push_back({(std::filesystem::path(options.out) / file.name).string(), file.bytes});
  write_together(files);
  JsonValue json, runs{JsonValue::Array{}};
  bool all_at_rest = true;
  for (const PaperSummaryRow& run : page.runs) {
    print_run(console, run);
    runs.push(run_json(run));
    all_at_rest = all_at_rest && (run.converged || run.mode == "as printed");
  }
  console.line("wrote " + index + " and " + std::to_string(page.files.size() - 1) +
               " pictures and tables beside it");
  json.set("index", index)
      .set("files", static_cast<std::int64_t>(page.files.size()))
      .set("runs", std::move(runs));
  console.result(json);
  if (all_at_rest) return 0;
  console.warn("a corrected experiment did not come to rest; the page says which");
  return 1;
}

}  // namespace

void declare_paper(const Command& parent) {
  const auto options = std::make_shared<PaperOptions>();
  const Command command =
      parent.command("paper", "Remake the founding paper's figures as a page: index.html, PNG, CSV");
  command.option("--out", options->out, "Folder to write into");
  command.option("--figure", options->figure, "Only this figure").among({1, 4, 6, 7, 8});
  command.examples({"fuai paper", "fuai paper --figure 4 --out /tmp/figure4"});
  command.body([options](const Console& console) { return run_paper(console, *options); });
}

}  // namespace fuai_app
