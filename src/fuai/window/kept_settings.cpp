// Reads and writes the settings by one table of their keys.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/kept_settings.h"

#include <cstdlib>
#include <filesystem>

#include "fuai/core/error.h"
#include "fuai/io/text_file.h"
#include "fuai/io/toml_tree.h"

namespace fuai {
namespace {

/// A choice between two words or, without words, between true and false.
struct Choice {
  const char* key;
  const char* off;  ///< word of false
  const char* on;   ///< word of true
  bool (*get)(const ViewSettings&);
  void (*set)(ViewSettings&, bool);
};

template <bool ViewSettings::*kMember>
constexpr Choice switch_of(const char* key, const char* off = nullptr, const char* on = nullptr) {
  return {key, off, on, [](const ViewSettings& s) { return s.*kMember; },
          [](ViewSettings& s, bool value) { s.*kMember = value; }};
}

constexpr Choice kChoices[] = {
    {"language", "en", "ja", [](const ViewSettings& s) { return s.language == Language::kJapanese; },
     [](ViewSettings& s, bool on) { s.language = on ? Language::kJapanese : Language::kEnglish; }},
    switch_of<&ViewSettings::dark>("theme", "light", "dark"),
    {"units", "kes", "si", [](const ViewSettings& s) { return s.units == UnitSystem::kSi; },
     [](ViewSettings& s, bool on) { s.units = on ? UnitSystem::kSi : UnitSystem::kKes; }},
    switch_of<&ViewSettings::fabric_panel>("fabric_panel"),
    switch_of<&ViewSettings::plots>("plots"),
    switch_of<&ViewSettings::yarns>("weave"),
    switch_of<&ViewSettings::lines>("lines"),
    switch_of<&ViewSettings::arrows>("arrows"),
    switch_of<&ViewSettings::ground>("floor"),
};

/// Key of the size of the letters.
constexpr const char* kLetters = "scale_percent";

bool value_of(const Choice& choice, const TomlNode& node, const std::string& name) {
  const bool words = choice.on != nullptr;
  if (!words && node.kind == TomlNode::Kind::kBoolean) return node.boolean;
  if (words && node.is_text() && node.text == choice.on) return true;
  if (words && node.is_text() && node.text == choice.off) return false;
  throw Error(ErrorKind::kBadInput, "this value is not known", {name, node.line, node.column, choice.key},
              words ? std::string("write \"") + choice.off + "\" or \"" + choice.on + "\""
                    : std::string("write true or false"));
}

}  // namespace

std::string kept_settings_path() {
  // The XDG base directory specification: a path that is not absolute counts as none.
  namespace fs = std::filesystem;
  const auto folder = [](const char* variable) {
    const char* text = std::getenv(variable);
    const fs::path path(text == nullptr ? "" : text);
    return path.is_absolute() ? path : fs::path();
  };
  fs::path config = folder("XDG_CONFIG_HOME");
  if (const fs::path home = folder("HOME"); config.empty() && !home.empty()) config = home / ".config";
  return config.empty() ? std::string() : (config / "fuai" / "viewer.toml").string();
}

std::string format_kept_settings(const KeptSettings& kept) {
  std::string text = "# What the viewer of fuai remembers; it writes this file when it ends.\n";
  for (const Choice& choice : kChoices) {
    const bool on = choice.get(kept.settings);
    text += std::string(choice.key) + " = ";
    text += choice.on == nullptr ? (on ? "true" : "false") : toml_string(on ? choice.on : choice.off);
    text += "\n";
  }
  text += std::string(kLetters) + " = " + std::to_string(kept.settings.letters) + "\n";
  if (!kept.folder.empty()) text += "folder = " + toml_string(kept.folder) + "\n";
  return text;
}

KeptSettings parse_kept_settings(std::string_view text, const std::string& name) {
  const TomlNode root = parse_toml(text, name);
  KeptSettings kept;
  for (const Choice& choice : kChoices)
    if (const TomlNode* node = root.find(choice.key))
      choice.set(kept.settings, value_of(choice, *node, name));
  if (const TomlNode* node = root.find(kLetters)) {
    if (node->kind != TomlNode::Kind::kInteger || node->integer < kLeastLetters ||
        node->integer > kMostLetters)
      throw Error(ErrorKind::kBadInput, "this value is not known", {name, node->line, node->column, kLetters},
                  "write a whole number of percent from " + std::to_string(kLeastLetters) + " to " +
                      std::to_string(kMostLetters));
    kept.settings.letters = static_cast<int>(node->integer);
  }
  if (const TomlNode* node = root.find("folder")) {
    if (!node->is_text())
      throw Error(ErrorKind::kBadInput, "a text is expected", {name, node->line, node->column, "folder"},
                  "write it in quotes");
    kept.folder = node->text;
  }
  return kept;
}

KeptSettings read_kept_settings(const std::string& path) {
  std::error_code code;  // what cannot be looked at is told by the reader
  if (path.empty() || (!std::filesystem::exists(path, code) && !code)) return {};
  return parse_kept_settings(read_text_file(path), path);
}

void write_kept_settings(const std::string& path, const KeptSettings& kept) {
  std::error_code code;  // what went wrong is told by the writer
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), code);
  write_atomically(path, format_kept_settings(kept));
}

ViewSettings settings_to_keep(const ViewSettings& before, const ViewSettings& start,
                              const ViewSettings& end) {
  ViewSettings keep = before;
  for (const Choice& choice : kChoices)
    if (choice.get(end) != choice.get(start)) choice.set(keep, choice.get(end));
  if (end.letters != start.letters) keep.letters = end.letters;
  return keep;
}

}  // namespace fuai
