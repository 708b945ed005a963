// What scenes are called in the window.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

#include "fuai/scenes/catalogue.h"
#include "fuai/window/ui_text.h"

namespace fuai {

/// The name of a scene for people; null for one that has none, which the window calls as the command line
/// does. Thread class: any.
const char* scene_text(std::string_view scene, Language language);

/// What happens in it; the catalogue's own words where there are none in the language. Thread class: any.
std::string_view scene_description(const SceneEntry& scene, Language language);

}  // namespace fuai
