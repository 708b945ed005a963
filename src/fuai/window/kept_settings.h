// What the window remembers from one time to the next, and the file it stands in.
// SPDX-License-Identifier: Apache-2.0
// Source: docs/viewer.md.
#pragma once

#include <string>
#include <string_view>

#include "fuai/window/view_settings.h"

namespace fuai {

/// The choices that are kept: language, units, theme, size, what is shown; and where files were last opened.
/// Of the settings nothing else is read or written.
struct KeptSettings {
  ViewSettings settings;
  std::string folder;  ///< where files were last opened; empty: nowhere yet
};

/// "$XDG_CONFIG_HOME/fuai/viewer.toml", else below ~/.config; empty where neither variable names an absolute
/// path. Thread class: set-up.
std::string kept_settings_path();

/// The text of the file. Thread class: any.
std::string format_kept_settings(const KeptSettings& kept);

/// Reads the text of a file over the defaults; a key that is not known is left out, as another version may
/// have written it. @param name of the file, for messages
/// @throws Error (kBadInput) with line and column: broken TOML, a value of another kind. Thread class:
/// set-up.
KeptSettings parse_kept_settings(std::string_view text, const std::string& name);

/// The defaults where there is no file or `path` is empty. @throws Error (kBadInput) as read_text_file() and
/// parse_kept_settings(). Thread class: set-up.
KeptSettings read_kept_settings(const std::string& path);

/// Writes the file whole or not at all, and its folder when it is not there. @throws Error (kBadInput).
/// Thread class: set-up.
void write_kept_settings(const std::string& path, const KeptSettings& kept);

/// What to keep at the end: what was changed since the start, else what was kept before, so that an option of
/// the command line holds for one time only. @param before of the file @param start with the options
/// @param end as they are now. Thread class: any.
ViewSettings settings_to_keep(const ViewSettings& before, const ViewSettings& start, const ViewSettings& end);

}  // namespace fuai
