// Reads a U3M / FAB physics file and prints how well each law repeats what was measured.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "fuai/core/error.h"
#include "fuai/fabric/fab_fabric.h"
#include "fuai/fabric/laws.h"
#include "fuai/io/u3m.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: import_and_ask FILE.physics.json\n", stderr);
    return 2;
  }
  try {
    const fuai::Fabric fabric = fuai::make_fabric_from_fab(fuai::read_u3m_physics(argv[1]));
    const fuai::FabricLaws laws = fuai::make_fabric_laws(fabric);
    std::printf("%s, %.1f g/m2\n", fabric.name.c_str(), 1000.0 * laws.areal_mass);
    for (const fuai::LawReport& report : laws.reports) {
      std::printf("%-13s %s", report.law.c_str(), report.origin.c_str());
      if (report.origin == "measured loop")
        std::printf(", rms residual %.2f %% of the peak", 100.0 * report.rms_residual_fraction);
      std::printf("\n");
    }
    return 0;
  } catch (const fuai::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 3;
  }
}
