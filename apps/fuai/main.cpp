// The command-line program: options, dispatch, exit codes. The only file that includes CLI11.
// SPDX-License-Identifier: Apache-2.0
#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>

#include "commands.h"
#include "fuai/core/error.h"
#include "fuai/io/nearest_name.h"
#include "fuai/scenes/engine_scene.h"

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
  ImportOptions importing;
  ShowOptions show;
  PaperOptions paper;
  RenderOptions render;
  SimulateOptions simulate;
  CantileverCommandOptions cantilever;
  DrapeCommandOptions drape;
  KesCommandOptions kes;
  LoopCommandOptions loop;
  std::function<int(const Console&)> run;
};

void add_import_command(CLI::App& fabric, Parsed& parsed) {
  CLI::App* command = fabric.add_subcommand(
      "import", "Measurements in: U3M/FAB physics JSON, KES curve CSV, KES sheet -> fabric file");
  command
      ->add_option("FILE", parsed.importing.files,
                   "Files of one fabric; one KES sheet may hold several fabrics")
      ->required();
  command
      ->add_option("-o,--output", parsed.importing.output,
                   "Fabric file to write; a folder for a sheet of several fabrics")
      ->required();
  command->add_option("--name", parsed.importing.name, "Name of the fabric, instead of the one in the file");
  command->add_option("--mass", parsed.importing.mass,
                      "Areal mass with unit, e.g. '16.3 mg/cm2'; needed with curve files alone");
  command->add_option("--thickness", parsed.importing.thickness, "Thickness with unit, e.g. 0.4mm");
  command->add_option("--test", parsed.importing.test,
                      "Test of a curve file that does not say: bending, shear, tensile, compression");
  command->add_option("--direction", parsed.importing.direction,
                      "Direction of a curve file that does not say: warp, weft, bias");
  command->footer(
      "Examples:\n  fuai fabric import cupro.physics.json -o cupro.fabric.toml\n"
      "  fuai fabric import bend-warp.csv bend-weft.csv --mass '16 mg/cm2' -o wool.fabric.toml\n"
      "  fuai fabric import kes-sheet.csv -o fabrics/");
  command->callback([&] { parsed.run = [&](const Console& c) { return run_import(c, parsed.importing); }; });
}

void add_fabric_commands(CLI::App& app, Parsed& parsed) {
  CLI::App* fabrics = app.add_subcommand("fabrics", "List the bundled fabrics, one line each");
  fabrics->footer("Examples:\n  fuai fabrics\n  fuai --json fabrics");
  fabrics->callback([&] { parsed.run = run_fabrics; });

  CLI::App* fabric = app.add_subcommand("fabric", "Import or show one fabric");
  fabric->require_subcommand(1);
  fabric->footer(
      "Examples:\n  fuai fabric show wool-tropical\n"
      "  fuai fabric import cupro.physics.json -o cupro.fabric.toml");
  add_import_command(*fabric, parsed);

  CLI::App* show = fabric->add_subcommand("show", "Every parameter in KES units and SI with its provenance");
  show->add_option("FABRIC", parsed.show.fabric, "Bundled name or path of a fabric file")->required();
  show->add_option("--plot", parsed.show.plot,
                   "Draw measured points and fitted loops into FILE.png or FILE.svg");
  show->footer(
      "Examples:\n  fuai fabric show wool-tropical\n"
      "  fuai fabric show cupro-woven-su1098 --plot cupro.svg");
  show->callback([&] { parsed.run = [&](const Console& c) { return run_show(c, parsed.show); }; });
}

void add_size_options(CLI::App& command, int& size, std::string& spacing) {
  command.add_option("--size", size, "Nodes on the longer side; default: the scene's own (`fuai scenes`)")
      ->check(CLI::Range(fuai::kLeastSceneSize, fuai::kMostSceneSize));
  command.add_option("--spacing", spacing,
                     "Distance of the nodes with unit, e.g. 5mm; default: the scene's own, 1cm");
}

void add_simulate_command(CLI::App& app, Parsed& parsed) {
  constexpr int kMostIterations = 1000;
  SimulateOptions& options = parsed.simulate;
  CLI::App* command = app.add_subcommand(
      "simulate", "A scene in time on the cloth engine or another solver: state, force, energy, time a step");
  command->add_option("SCENE", options.scene, "A name that `fuai scenes` lists, not one of the paper's")
      ->required();
  command->add_option("--fabric", options.fabric, "Bundled name or path of a fabric file")
      ->capture_default_str();
  add_size_options(*command, options.size, options.spacing);
  command->add_option("--dt", options.dt, "Length of a step with unit, 1us to 1s")->capture_default_str();
  command->add_option("--seconds", options.seconds,
                      "How long, up to 3600; a number of seconds or a time such as 500ms. Default: the "
                      "scene's own");
  std::string solvers = "Who computes:";
  for (const fuai::SolverEntry& entry : fuai::solver_entries())
    solvers.append("\n").append(entry.name).append(" - ").append(entry.description);
  command->add_option("--solver", options.solver, solvers)->capture_default_str();
  command
      ->add_option(
          "--iterations", options.iterations,
          "Conjugate gradients a linearisation, default 8; substeps of the explicit solver, default as "
          "many as are safe; steps of the paper's in a tick, default 100")
      ->check(CLI::Range(1, kMostIterations));
  command
      ->add_option("--precision", options.precision,
                   "Of the implicit solver: float, as at run time, or double, as --solver double")
      ->check(CLI::IsMember({"float", "double"}));
  command->add_option("--record", options.record,
                      "CSV file with a row a step: time, hand, force, moment, status, residual");
  command->footer(
      "Examples:\n  fuai simulate hanging_sheet\n"
      "  fuai simulate taut_patch --fabric wool-tropical --seconds 1 --record pull.csv\n"
      "  fuai --json simulate corner_drape --spacing 5mm --dt 500us --solver double\n"
      "  fuai simulate corner_drape --solver paper");
  command->callback([&] { parsed.run = [&](const Console& c) { return run_simulate(c, parsed.simulate); }; });
}

void add_scene_commands(CLI::App& app, Parsed& parsed) {
  CLI::App* paper =
      app.add_subcommand("paper", "Remake the founding paper's figures as a page: index.html, PNG, CSV");
  paper->add_option("--out", parsed.paper.out, "Folder to write into")->capture_default_str();
  paper->add_option("--figure", parsed.paper.figure, "Only this figure")
      ->check(CLI::IsMember({1, 4, 6, 7, 8}));
  paper->footer("Examples:\n  fuai paper\n  fuai paper --figure 4 --out /tmp/figure4");
  paper->callback([&] { parsed.run = [&](const Console& c) { return run_paper(c, parsed.paper); }; });

  CLI::App* scenes = app.add_subcommand("scenes", "List the scenes, one line each");
  scenes->footer("Examples:\n  fuai scenes\n  fuai --json scenes");
  scenes->callback([&] { parsed.run = run_scenes; });

  CLI::App* render = app.add_subcommand("render", "A picture of a scene, without a display");
  render->add_option("SCENE", parsed.render.scene, "A name that `fuai scenes` lists")->required();
  render->add_option("--fabric", parsed.render.fabric, "Bundled name or path of a fabric file")
      ->capture_default_str();
  render->add_option("--time", parsed.render.time,
                     "Time with unit, e.g. 2s. Default: when the scene shows what it is about. Scenes of the "
                     "paper count ten updates "
                     "a second, as the paper did; their default: at rest");
  render->add_option("-o,--output", parsed.render.output, "PNG file to write")->required();
  add_size_options(*render, parsed.render.size, parsed.render.spacing);
  render->add_option("--width", parsed.render.width, "Pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  render->add_option("--height", parsed.render.height, "Pixels")
      ->check(CLI::Range(16, 8192))
      ->capture_default_str();
  render->add_flag("--as-printed", parsed.render.as_printed,
                   "The paper's method with all its faults, instead of the corrected one");
  render->footer(
      "Examples:\n  fuai render hanging_sheet --fabric wool-tropical --time 2s -o sheet.png\n"
      "  fuai render corner_drape --spacing 5mm -o drape.png\n"
      "  fuai render paper_drape --fabric graded-10 --time 30s --as-printed -o paper.png");
  render->callback([&] { parsed.run = [&](const Console& c) { return run_render(c, parsed.render); }; });
  add_simulate_command(app, parsed);
}

void add_cantilever_command(CLI::App& app, Parsed& parsed) {
  CantileverCommandOptions& options = parsed.cantilever;
  CLI::App* command = app.add_subcommand(
      "cantilever", "A strip clamped level at one end, hanging under its own weight: bending length");
  command->add_option("FABRIC", options.fabric, "Bundled name or path of a fabric file")->required();
  command->add_option("--direction", options.direction, "Yarns along the strip: warp or weft")
      ->check(CLI::IsMember({"warp", "weft"}))
      ->capture_default_str();
  CLI::Option_group* how = command->add_option_group("Length", "One of");
  how->add_option("--length", options.length, "Free length with unit, at least four spacings");
  how->add_option(
      "--angle", options.angle,
      "Find the overhang whose chord lies at this angle below level: 41.5deg as ASTM D1388, or 43deg");
  how->require_option(1);
  command->add_option("--width", options.width, "Width with unit, at least two spacings")
      ->capture_default_str();
  command->add_option("--spacing", options.spacing,
                      "Distance of the nodes with unit. Default: a fortieth of the length, at most half the "
                      "width");
  command->add_flag("--elastic", options.elastic, "Without friction: the elastic curves of the laws alone");
  command->footer(
      "Examples:\n  fuai cantilever wool-tropical --length 10cm\n"
      "  fuai cantilever cupro-woven-su1098 --direction weft --length 8cm --elastic\n"
      "  fuai cantilever wool-tropical --angle 41.5deg\n"
      "  fuai --json cantilever graded-6 --length 15cm --spacing 5mm");
  command->callback(
      [&] { parsed.run = [&](const Console& c) { return run_cantilever(c, parsed.cantilever); }; });
}

void add_drape_command(CLI::App& app, Parsed& parsed) {
  constexpr int kMostSpecimens = 1000;
  DrapeCommandOptions& options = parsed.drape;
  CLI::App* command =
      app.add_subcommand("drape", "The drape test: drape coefficient, nodes, shadow, pictures, mesh");
  command->add_option("FABRIC", options.fabric, "Bundled name or path of a fabric file")->required();
  command->add_option("--disc", options.disc, "Diameter of the disc with unit")->capture_default_str();
  command->add_option("--specimen", options.specimen, "Diameter of the cloth with unit")
      ->capture_default_str();
  command->add_option("--spacing", options.spacing, "Distance of the nodes with unit")->capture_default_str();
  command->add_option("--runs", options.runs, "Specimens, each with a seed of its own")
      ->check(CLI::Range(1, kMostSpecimens))
      ->capture_default_str();
  command
      ->add_option("--path", options.path,
                   "How the weight comes on: gravity ramp, sudden release, ramp and three shakes, lowered "
                   "support")
      ->check(CLI::IsMember({"ramp", "release", "shakes", "support"}))
      ->capture_default_str();
  command->add_option("--ramp", options.loading, "How long the weight, or the support, takes, e.g. 4s")
      ->capture_default_str();
  command->add_flag("--elastic", options.elastic, "Without friction: the elastic curves of the laws alone");
  command->add_flag("--no-bands", options.no_bands, "Do not try the ends of what was assumed");
  command->add_flag("--convergence", options.convergence,
                    "At 2, 1.5, 1 and 0.75 times the spacing too, with a plot in --out");
  command->add_option("--solver", options.solver, "implicit, or explicit: the oracle, minutes a specimen")
      ->check(CLI::IsMember({"implicit", "explicit"}))
      ->capture_default_str();
  command->add_option("--linger", options.linger, "Goes on so long once the cloth rests, e.g. 2s");
  command->add_option("--out", options.out, "Folder for shadow, pictures, mesh and tables");
  command->footer(
      "Examples:\n  fuai drape wool-tropical --out drape\n"
      "  fuai drape polyester-faille --disc 12.7cm --specimen 25.4cm\n"
      "  fuai --json --seed 7 drape graded-6 --runs 2 --elastic");
  command->callback([&] { parsed.run = [&](const Console& c) { return run_drape(c, parsed.drape); }; });
}

void add_loop_command(CLI::App& app, Parsed& parsed) {
  constexpr int kFewestSegments = 16, kMostSegments = 1000;
  LoopCommandOptions& options = parsed.loop;
  CLI::App* command = app.add_subcommand(
      "loop", "A strip whose ends are brought together in a clamp hangs in a loop: height, bending length");
  command
      ->add_option("LOOP", options.kind,
                   "heart, pear or ring: the ends leave the clamp upward, downward, level")
      ->check(CLI::IsMember({"heart", "pear", "ring"}))
      ->required();
  command->add_option("FABRIC", options.fabric, "Bundled name or path of a fabric file")->required();
  command->add_option("--direction", options.direction, "Yarns along the strip: warp or weft")
      ->check(CLI::IsMember({"warp", "weft"}))
      ->capture_default_str();
  command->add_option("--length", options.length, "Of the strip between the clamps, with unit")
      ->capture_default_str();
  command->add_option("--segments", options.segments, "Yarn crossings along the strip")
      ->check(CLI::Range(kFewestSegments, kMostSegments))
      ->capture_default_str();
  command->add_flag("--elastic", options.elastic, "Without friction: the elastic curves of the laws alone");
  command->footer(
      "Examples:\n  fuai loop heart wool-tropical\n"
      "  fuai loop pear cotton-knit-shirley --direction weft --length 15cm --elastic");
  command->callback([&] { parsed.run = [&](const Console& c) { return run_loop(c, parsed.loop); }; });
}

void add_kes_command(CLI::App& app, Parsed& parsed) {
  KesCommandOptions& options = parsed.kes;
  CLI::App* command = app.add_subcommand(
      "kes",
      "A fabric in a virtual instrument (KES, or the Fabric Analyzer): the loop and its parameters beside "
      "the fabric's own");
  command
      ->add_option(
          "TEST", options.test,
          "bending (FB2), tensile or shear (FB1); buckling or stretch as the Fabric Analyzer does them")
      ->check(CLI::IsMember({"bending", "tensile", "shear", "buckling", "stretch"}))
      ->required();
  command->add_option("FABRIC", options.fabric, "Bundled name or path of a fabric file")->required();
  command
      ->add_option("--direction", options.direction,
                   "Yarns from clamp to clamp: warp or weft. Default: warp; in shear the mean of both")
      ->check(CLI::IsMember({"warp", "weft"}));
  command->add_option("--reverse", options.reverse,
                      "Partial reversals on the way to the first stop, OUT or OUT:BACK in 1/cm, degrees or "
                      "percent; BACK is 0, in tension no load, where it is left out");
  command->add_option("--spacing", options.spacing,
                      "Distance of the nodes with unit; must divide the specimen's length, 1 cm in bending, "
                      "else 5 cm. Default: 2 mm in bending, 5 mm in shear, 1 cm in tension");
  command->add_option("--csv", options.csv, "Write the simulated curve as a curve file");
  command->add_option("--plot", options.plot,
                      "Draw the simulated loop over the fabric's into FILE.png or FILE.svg");
  command->footer(
      "Examples:\n  fuai kes bending wool-tropical\n"
      "  fuai kes shear wool-tropical --plot shear.png --csv shear.csv\n"
      "  fuai --json kes tensile cupro-woven-su1098 --direction weft\n"
      "  fuai kes bending polyester-faille --reverse 0.5 1 1.5:0.5 --plot minor.svg");
  command->callback([&] { parsed.run = [&](const Console& c) { return run_kes(c, parsed.kes); }; });
}

/// Reads --config as CLI11 does, without the options that an environment variable states: CLI11 itself would
/// let the file win.
class FileBelowEnvironment : public CLI::ConfigTOML {
 public:
  explicit FileBelowEnvironment(const CLI::App& app) : app_(app) {}

  std::vector<CLI::ConfigItem> from_config(std::istream& input) const override {
    std::vector<CLI::ConfigItem> found = CLI::ConfigTOML::from_config(input);
    std::erase_if(found, [&](const CLI::ConfigItem& item) {
      if (!item.parents.empty()) return false;
      const CLI::Option* option = app_.get_option_no_throw("--" + item.name);
      const char* stated =
          option && !option->get_envname().empty() ? std::getenv(option->get_envname().c_str()) : nullptr;
      return stated && *stated;
    });
    return found;
  }

 private:
  const CLI::App& app_;
};

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
  app.config_formatter(std::make_shared<FileBelowEnvironment>(app));
  app.allow_config_extras(CLI::config_extras_mode::error);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Examples:\n  fuai fabrics\n  fuai fabric show wool-tropical\n"
      "  fuai render hanging_sheet --fabric wool-tropical -o sheet.png\n"
      "  fuai simulate taut_patch --record pull.csv\n"
      "  fuai COMMAND --help\n\n"
      "A FABRIC is a bundled name (`fuai fabrics`) or the path of a fabric file. Values take units: 18cm, "
      "20gf, 1ms.\n"
      "Exit codes: 0 done, 1 a check failed, 2 wrong usage, 3 bad input, 4 no device or display.");
}

/// The innermost command that was named.
const CLI::App& innermost(const CLI::App& app) {
  const std::vector<CLI::App*> named = app.get_subcommands();
  return named.empty() ? app : innermost(*named.front());
}

std::string full_name(const CLI::App& app) {
  return app.get_parent() ? full_name(*app.get_parent()) + " " + app.get_name() : app.get_name();
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

/// "; did you mean --time?" or nothing.
std::string suggestion(const std::string& word, const std::vector<std::string>& names) {
  const std::vector<std::string> nearest = fuai::nearest_names(word, names);
  return nearest.empty() ? "" : "; did you mean '" + nearest.front() + "'?";
}

/// Says which word is no command, or prints the help when there is no word at all. False when the command is
/// complete and something else is missing.
bool explain_command(const CLI::App& app) {
  const CLI::App& at = innermost(app);
  const std::vector<std::string> names = command_names(at);
  if (names.empty()) return false;
  const std::vector<std::string> words = app.remaining(true);
  if (words.empty()) {
    std::fputs(app.help().c_str(), stderr);
    return true;
  }
  const bool is_option = words.front().starts_with('-');
  std::fprintf(stderr, "fuai: `%s` has no %s '%s'%s\nThe commands are %s.\n", full_name(at).c_str(),
               is_option ? "option" : "command", words.front().c_str(),
               is_option ? "" : suggestion(words.front(), names).c_str(), fuai::either(names).c_str());
  return true;
}

/// Says which words were too many, with the option that may have been meant.
void explain_extras(const CLI::App& app) {
  const CLI::App& at = innermost(app);
  std::vector<std::string> options;
  for (const CLI::App* level = &at; level; level = level->get_parent()) {
    for (const CLI::Option* option : level->get_options()) {
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
    }
  }
  const std::string word = app.remaining(true).front();
  std::fprintf(stderr, "fuai: `%s` does not take '%s'%s\nRun `%s --help` for its options.\n",
               full_name(at).c_str(), word.c_str(),
               word.starts_with("--") ? suggestion(word, options).c_str() : "", full_name(at).c_str());
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"fuai: see and feel virtual cloth made of a measured fabric", "fuai"};
  Parsed parsed;
  add_common_options(app, parsed);
  add_fabric_commands(app, parsed);
  add_scene_commands(app, parsed);
  add_cantilever_command(app, parsed);
  add_drape_command(app, parsed);
  add_loop_command(app, parsed);
  add_kes_command(app, parsed);
  try {
    app.parse(argc, argv);
  } catch (const CLI::FileError& e) {
    std::fprintf(stderr, "fuai: %s\n", e.what());
    return kExitBadInput;
  } catch (const CLI::ConfigError& e) {
    std::fprintf(stderr, "fuai: --config: %s; `fuai --help` and `fuai COMMAND --help` list the options\n",
                 e.what());
    return kExitBadInput;
  } catch (const CLI::RequiredError& e) {
    if (explain_command(app)) return kExitUsage;
    return app.exit(e), kExitUsage;
  } catch (const CLI::ExtrasError&) {
    explain_extras(app);
    return kExitUsage;
  } catch (const CLI::ParseError& e) {
    // Help and version exit with 0; anything else is wrong usage.
    return app.exit(e) == 0 ? 0 : kExitUsage;
  }
  parsed.common.verbosity = parsed.quiet ? -1 : (parsed.verbose ? 1 : 0);
  const Console console(parsed.common);
  console.detail("seed " + std::to_string(parsed.common.seed) + ", threads " +
                 (parsed.common.threads == 0 ? "all" : std::to_string(parsed.common.threads)));
  return parsed.run(console);
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
