// The command-line program: options, dispatch, exit codes. The only file that includes CLI11.
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <functional>

#include "commands.h"
#include "fuai/core/error.h"

namespace fuai_app {
namespace {

constexpr int kExitCheckFailed = 1, kExitUsage = 2, kExitBadInput = 3, kExitNoDevice = 4;

int exit_code(fuai::ErrorKind kind) {
  switch (kind) {
    case fuai::ErrorKind::kCheckFailed:
      return kExitCheckFailed;
    case fuai::ErrorKind::kUsage:
      return kExitUsage;
    case fuai::ErrorKind::kBadInput:
      return kExitBadInput;
    case fuai::ErrorKind::kNoDevice:
      return kExitNoDevice;
  }
  return kExitCheckFailed;
}

/// Everything the parser fills.
struct Parsed {
  CommonOptions common;
  bool verbose = false, quiet = false;
  ImportOptions import;
  ShowOptions show;
  PaperOptions paper;
  RenderOptions render;
  std::function<int(const Console&)> run;
};

void add_fabric_commands(CLI::App& app, Parsed& parsed) {
  CLI::App* fabrics = app.add_subcommand("fabrics", "List the bundled fabrics, one line each");
  fabrics->footer("Examples:\n  fuai fabrics\n  fuai --json fabrics");
  fabrics->callback([&] { parsed.run = run_fabrics; });

  CLI::App* fabric = app.add_subcommand("fabric", "Import or show one fabric");
  fabric->require_subcommand(1);

  CLI::App* import = fabric->add_subcommand(
      "import", "Measurements in: U3M/FAB physics JSON, KES curve CSV, KES sheet -> fabric file");
  import
      ->add_option("FILE", parsed.import.files, "Files of one fabric; one KES sheet may hold several fabrics")
      ->required();
  import
      ->add_option("-o,--output", parsed.import.output,
                   "Fabric file to write; a folder for a sheet of several fabrics")
      ->required();
  import->add_option("--name", parsed.import.name, "Name of the fabric, instead of the one in the file");
  import->add_option("--mass", parsed.import.mass,
                     "Areal mass with unit, e.g. '16.3 mg/cm2'; needed with curve files alone");
  import->add_option("--thickness", parsed.import.thickness, "Thickness with unit, e.g. 0.4mm");
  import->add_option("--test", parsed.import.test,
                     "Test of a curve file that does not say: bending, shear, tensile, compression");
  import->add_option("--direction", parsed.import.direction,
                     "Direction of a curve file that does not say: warp, weft, bias");
  import->footer(
      "Examples:\n  fuai fabric import cupro.physics.json -o cupro.fabric.toml\n"
      "  fuai fabric import wool.bending.warp.csv wool.bending.weft.csv --mass '16 mg/cm2' -o "
      "wool.fabric.toml\n"
      "  fuai fabric import kes-sheet.csv -o fabrics/");
  import->callback([&] { parsed.run = [&](const Console& c) { return run_import(c, parsed.import);
};
}  // namespace
);

CLI::App* show = fabric->add_subcommand("show", "Every parameter in KES units and SI with its provenance");
show->add_option("FABRIC", parsed.show.fabric, "Bundled name or path of a fabric file")->required();
show->add_option("--plot", parsed.show.plot,
                 "Draw measured points and fitted loops into FILE.png or FILE.svg");
show->footer(
    "Examples:\n  fuai fabric show wool-tropical\n  fuai fabric show cupro-woven-su1098 --plot cupro.svg");
show->callback([&] { parsed.run = [&](const Console& c) { return run_show(c, parsed.show); }; });
}  // namespace fuai_app

void add_scene_commands(CLI::App& app, Parsed& parsed) {
  CLI::App* paper =
      app.add_subcommand("paper", "Remake the founding paper's figures as a page: index.html, PNG, CSV");
  paper->add_option("--out", parsed.paper.out, "Folder to write into")->capture_default_str();
  paper->add_option("--figure", parsed.paper.figure, "Only this figure")
      ->check(CLI::IsMember({1, 4, 6, 7, 8}));
  paper->footer("Examples:\n  fuai paper\n  fuai paper --figure 4 --out /tmp/figure4");
  paper->callback([&] { parsed.run = [&](const Console& c) { return run_paper(c, parsed.paper); }; });

  CLI::App* scenes = app.add_subcommand("scenes", "List the scenes, one line each");
  scenes->callback([&] { parsed.run = run_scenes; });

  CLI::App* render = app.add_subcommand("render", "A picture of a scene, without a display");
  render->add_option("SCENE", parsed.render.scene, "A name that `fuai scenes` lists")->required();
  render->add_option("--fabric", parsed.render.fabric, "Bundled name or path of a fabric file")
      ->capture_default_str();
  render->add_option("--time", parsed.render.time,
                     "Time with unit, e.g. 2s; a relaxation counts ten updates a second, as the paper did. "
                     "Default: at rest");
  render->add_option("-o,--output", parsed.render.output, "PNG file to write")->required();
  render->add_option("--width", parsed.render.width, "Pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  render->add_option("--height", parsed.render.height, "Pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  render->add_flag("--as-printed", parsed.render.as_printed,
                   "The paper's method with all its faults, instead of the corrected one");
  render->footer(
      "Examples:\n  fuai render paper_drape --fabric wool-tropical -o drape.png\n"
      "  fuai render paper_drape --fabric graded-10 --time 30s --as-printed -o paper.png");
  render->callback([&] { parsed.run = [&](const Console& c) { return run_render(c, parsed.render); }; });
}

void add_common_options(CLI::App& app, Parsed& parsed) {
  app.set_version_flag("--version", std::string("fuai ") + FUAI_VERSION);
  app.add_flag("--json", parsed.common.json, "One JSON object on standard output, nothing else there")
      ->envname("FUAI_JSON");
  app.add_flag("-v,--verbose", parsed.verbose, "Say more, on standard error");
  app.add_flag("-q,--quiet", parsed.quiet, "Say only warnings and errors");
  app.add_option("--seed", parsed.common.seed, "Seed of everything random")
      ->envname("FUAI_SEED")
      ->capture_default_str();
  app.add_option("--threads", parsed.common.threads, "Threads; 0 takes all cores")
      ->envname("FUAI_THREADS")
      ->check(CLI::Range(0, 256))
      ->capture_default_str();
  app.set_config("--config", "", "Options from a TOML file; flags go over environment over file");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "A FABRIC is a bundled name (`fuai fabrics`) or the path of a fabric file. Values take units: 18cm, "
      "20gf, 1ms.\n"
      "Exit codes: 0 done, 1 a check failed, 2 wrong usage, 3 bad input, 4 no device or display.");
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"fuai: see and feel virtual cloth made of a measured fabric", "fuai"};
  Parsed parsed;
  add_common_options(app, parsed);
  add_fabric_commands(app, parsed);
  add_scene_commands(app, parsed);
  try {
    app.parse(argc, argv);
  } catch (const CLI::FileError& e) {
    std::fprintf(stderr, "fuai: %s\n", e.what());
    return kExitBadInput;
  } catch (const CLI::ParseError& e) {
    // Help and version exit with 0; anything else is wrong usage.
    return app.exit(e) == 0 ? 0 : kExitUsage;
  }
  parsed.common.verbosity = parsed.quiet ? -1 : (parsed.verbose ? 1 : 0);
  return parsed.run(Console(parsed.common));
}

}  // namespace
}  // namespace fuai_app

int main(int argc, char** argv) {
  try {
    return fuai_app::parse_and_run(argc, argv);
  } catch (const fuai::Error& e) {
    std::fprintf(stderr, "fuai: %s\n", e.what());
    return fuai_app::exit_code(e.kind());
  } catch (const std::bad_alloc&) {
    std::fputs("fuai: out of memory\n", stderr);
    return fuai_app::kExitCheckFailed;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "fuai: internal error: %s\n", e.what());
    return fuai_app::kExitCheckFailed;
  }
}
