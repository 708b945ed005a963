// The command-line program: which commands there are, and exit codes.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <exception>
#include <new>

#include "commands.h"
#include "crash_report.h"
#include "fuai/core/error.h"

namespace fuai_app {
namespace {

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

void declare_commands(const Command& top) {
  declare_fabrics(top);
  const Command fabric = top.group("fabric", "Import, fit, show or compare fabrics, make a card");
  fabric.examples(
      {"fuai fabric show wool-tropical", "fuai fabric import cupro.physics.json -o cupro.fabric.toml"});
  declare_import(fabric);
  declare_show(fabric);
  declare_compare(fabric);
  declare_card(fabric);
  declare_fit(fabric);
  declare_bands(fabric);
  declare_paper(top);
  declare_scenes(top);
  declare_render(top);
  declare_simulate(top);
  declare_cantilever(top);
  declare_drape(top);
  declare_loop(top);
  declare_kes(top);
  declare_haptics(top);
  declare_replay(top);
  declare_view(top);
  declare_report(top);
  declare_batch(top, declare_commands);
}

}  // namespace
}  // namespace fuai_app

int main(int argc, char** argv) {
  fuai_app::report_crashes(FUAI_VERSION);
  try {
    return fuai_app::run_command_line(argc, argv, fuai_app::declare_commands);
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
