// `fuai haptics paper`: the paper's section 4.2 with a simulated hand, as a page.
// SPDX-License-Identifier: Apache-2.0
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "felt_bending.h"
#include "fuai/core/error.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/text_file.h"
#include "fuai/runtime/parallel.h"

namespace fuai_app {

using namespace fuai;

namespace {

struct PaperOptions {
  std::vector<std::string> fabrics;  ///< empty: all bundled ones
  std::string out = "out/felt";
};

JsonValue run_json(const FeltBending& run) {
  const double half = 0.5 * run.top();
  const auto pair = [&](bool paper) {
    return JsonValue()
        .set("out", run.push_at(half, false, paper))
        .set("back", run.push_at(half, true, paper));
  };
  return JsonValue()
      .set("fabric", run.id)
      .set("top_curvature_per_m", run.top())
      .set("reaction_at_half_N", pair(false))
      .set("paper_at_half_N", pair(true));
}

int run_paper(const Console& console, const PaperOptions& options) {
  std::vector<std::string> fabrics = options.fabrics;
  if (fabrics.empty()) fabrics = bundled_fabric_ids();
  std::error_code code;
  std::filesystem::create_directories(options.out, code);
  if (code) {
    throw Error(ErrorKind::kBadInput, "cannot make the folder: " + code.message(), {options.out, 0, 0, ""},
                "name another folder with --out");
  }
  const std::string index = (std::filesystem::path(options.out) / "index.html").string();
  check_can_write(index);
  std::vector<FeltBending> runs(fabrics.size());
  std::vector<std::function<void()>> tasks;
  for (std::size_t i = 0; i < fabrics.size(); ++i)
    tasks.emplace_back([&, i] { runs[i] = bend_in_hand(fabrics[i]); });
  run_parallel(tasks, console.options().threads);
  std::vector<NamedText> files;
  for (const OutputFile& file : felt_bending_page(runs))
    files.push_back({(std::filesystem::path(options.out) / file.name).string(), file.bytes});
  write_together(files);
  JsonValue list{JsonValue::Array{}};
  for (const FeltBending& run : runs) {
    const double half = 0.5 * run.top();
    console.line(run.id + ": " + format_number(1e3 * run.push_at(half, false, false)) + " mN out, " +
                 format_number(1e3 * run.push_at(half, true, false)) +
                 " mN back at half of the way; Eq. (7) " +
                 format_number(1e3 * run.push_at(half, false, true)) + " mN");
    list.push(run_json(run));
  }
  console.line("wrote " + index + " and " + std::to_string(files.size() - 1) + " plots and tables beside it");
  JsonValue json;
  json.set("index", index).set("files", static_cast<std::int64_t>(files.size()));
  console.result(json.set("runs", std::move(list)));
  return 0;
}

}  // namespace

void declare_haptics_paper(const Command& parent) {
  const auto options = std::make_shared<PaperOptions>();
  const Command command = parent.command(
      "paper", "The paper's section 4.2 in the hand: force against curvature of bent fabrics, as a page");
  command.option("FABRIC", options->fabrics, "Bundled names or paths; default: all bundled fabrics");
  command.option("-o,--out", options->out, "Folder to write into");
  command.examples({"fuai haptics paper -o out/felt", "fuai haptics paper wool-tropical polyester-faille"});
  command.body([options](const Console& console) { return run_paper(console, *options); });
}

}  // namespace fuai_app
