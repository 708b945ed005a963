// The one file that knows CLI11: commands, options, help, and messages for what cannot be read.
// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "fuai/io/nearest_name.h"

namespace fuai_app {

namespace {

/// How the help names the value of an option that names a file to write.
constexpr const char* kFileType = "FILE";

}  // namespace

Option& Option::required() {
  option_->required();
  return *this;
}

Option& Option::among(std::initializer_list<const char*> words) {
  option_->check(CLI::IsMember(std::vector<std::string>(words.begin(), words.end())));
  return *this;
}

Option& Option::among(std::initializer_list<int> numbers) {
  option_->check(CLI::IsMember(std::vector<int>(numbers)));
  return *this;
}

Option& Option::range(int least, int most) {
  option_->check(CLI::Range(least, most));
  return *this;
}

Option& Option::file() {
  option_->type_name(kFileType);
  return *this;
}

Command Command::command(const std::string& name, const std::string& about) const {
  return {app_->add_subcommand(name, about), chosen_};
}

Command Command::group(const std::string& name, const std::string& about) const {
  Command made = command(name, about);
  made.app_->require_subcommand(1);
  return made;
}

Command Command::one_of(const std::string& heading) const {
  CLI::Option_group* made = app_->add_option_group(heading, "");
  made->require_option(1);
  return {made, chosen_};
}

Option Command::option(const std::string& names, std::string& value, const std::string& help) const {
  CLI::Option* made = app_->add_option(names, value, help);
  return Option(value.empty() ? made : made->capture_default_str());
}

Option Command::option(const std::string& names, std::vector<std::string>& value,
                       const std::string& help) const {
  return Option(app_->add_option(names, value, help));
}

Option Command::option(const std::string& names, int& value, const std::string& help) const {
  CLI::Option* made = app_->add_option(names, value, help);
  return Option(value == 0 ? made : made->capture_default_str());
}

void Command::flag(const std::string& names, bool& value, const std::string& help) const {
  app_->add_flag(names, value, help);
}

void Command::examples(const std::vector<std::string>& lines) const {
  std::string text = "Examples:";
  for (const std::string& line : lines) text += "\n  " + line;
  app_->footer(text);
}

void Command::body(const CommandBody& run) const {
  app_->callback([chosen = chosen_, run] { *chosen = run; });
}

namespace {

/// The options that every command has.
struct Parsed {
  CommonOptions common;
  bool verbose = false, quiet = false;
};

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
  app.set_version_flag("--version", "fuai " + program_version());
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

/// The parser keeps what Command::one_of() makes among the commands, without a name.
bool is_option_group(const CLI::App* app) { return app->get_name().empty(); }

/// The innermost command that was named.
const CLI::App& innermost(const CLI::App& app) {
  for (const CLI::App* named : app.get_subcommands()) {
    if (!is_option_group(named)) return innermost(*named);
  }
  return app;
}

std::string full_name(const CLI::App& app) {
  return app.get_parent() ? full_name(*app.get_parent()) + " " + app.get_name() : app.get_name();
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App* at) { return !is_option_group(at); }))
    names.push_back(command->get_name());
  return names;
}

/// "; did you mean 'fabric'?" or nothing.
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

/// Long names of the options that a command takes, without the dashes.
void add_option_names(const CLI::App& app, std::vector<std::string>& names) {
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back(name);
  }
  for (const CLI::App* group : app.get_subcommands(is_option_group)) add_option_names(*group, names);
}

/// Says which words were too many, with the option that may have been meant. False when none were.
bool explain_extras(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining(true);
  if (words.empty()) return false;
  const CLI::App& at = innermost(app);
  std::vector<std::string> options;
  for (const CLI::App* level = &at; level; level = level->get_parent()) add_option_names(*level, options);
  const std::string& word = words.front();
  const std::vector<std::string> nearest =
      fuai::nearest_names(word.substr(std::min(word.size(), 2UL)), options);
  const std::string meant =
      word.starts_with("--") && !nearest.empty() ? "; did you mean '--" + nearest.front() + "'?" : "";
  std::fprintf(stderr, "fuai: `%s` does not take '%s'%s\nRun `%s --help` for its options.\n",
               full_name(at).c_str(), word.c_str(), meant.c_str(), full_name(at).c_str());
  return true;
}

/// Fills the shape with the options of a command and of its parts.
void add_shape(const CLI::App& app, CommandShape& shape) {
  using Kind = CommandShape::Kind;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      shape.words.push_back(option->get_name(true));
    } else if (option != app.get_help_ptr() && !option->get_lnames().empty()) {
      const std::string type = option->get_type_name();
      const Kind other =
          type == kFileType ? Kind::kFile : (type.starts_with("INT") ? Kind::kInteger : Kind::kText);
      shape.options.push_back(
          {option->get_lnames().front(), option->get_items_expected_max() == 0 ? Kind::kFlag : other});
    }
  }
  for (const CLI::App* group : app.get_subcommands(is_option_group)) add_shape(*group, shape);
}

constexpr const char* kAbout = "fuai: see and feel virtual cloth made of a measured fabric";

}  // namespace

/// A command line that is read for its mistakes alone.
struct CommandChecker::Parser {
  CLI::App app{kAbout, "fuai"};
  Parsed parsed;
  CommandBody chosen;
};

CommandChecker::CommandChecker(const DeclareCommands& declare) : parser_(std::make_unique<Parser>()) {
  add_common_options(parser_->app, parser_->parsed);
  declare(Command(&parser_->app, &parser_->chosen));
}

CommandChecker::~CommandChecker() = default;

CommandShape CommandChecker::shape_of(const std::string& command) const {
  CommandShape shape;
  add_shape(*parser_->app.get_subcommand(command), shape);
  return shape;
}

std::string CommandChecker::problem_of(const std::vector<std::string>& words) {
  try {
    parser_->app.parse(
        std::vector<std::string>(words.rbegin(), words.rend()));  // it takes them from the back
  } catch (const CLI::ParseError& e) {
    return e.what();
  }
  return {};
}

std::string program_version() { return FUAI_VERSION; }

int run_command_line(int argc, char** argv, const DeclareCommands& declare) {
  CLI::App app{kAbout, "fuai"};
  Parsed parsed;
  CommandBody chosen;
  add_common_options(app, parsed);
  declare(Command(&app, &chosen));
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
    if (!explain_command(app) && !explain_extras(app)) app.exit(e);
    return kExitUsage;
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
  return chosen(console);
}

}  // namespace fuai_app
