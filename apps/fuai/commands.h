// The commands. Each declares itself: name, options, help, examples and what it does.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "command_line.h"

namespace fuai_app {

/// @param all declares the commands, to check those of a manifest
void declare_batch(const Command& parent, const DeclareCommands& all);
void declare_bands(const Command& parent);
void declare_cantilever(const Command& parent);
void declare_card(const Command& parent);
void declare_compare(const Command& parent);
void declare_drape(const Command& parent);
void declare_fabrics(const Command& parent);
void declare_fit(const Command& parent);
void declare_haptics(const Command& parent);
/// @param parent the group `haptics`
void declare_haptics_paper(const Command& parent);
void declare_import(const Command& parent);
void declare_kes(const Command& parent);
void declare_loop(const Command& parent);
void declare_paper(const Command& parent);
void declare_render(const Command& parent);
void declare_replay(const Command& parent);
void declare_report(const Command& parent);
void declare_scenes(const Command& parent);
void declare_show(const Command& parent);
void declare_simulate(const Command& parent);
void declare_view(const Command& parent);

}  // namespace fuai_app
