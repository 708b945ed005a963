// A program outside the project: load a bundled fabric and ask its law.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "fuai/fabric/laws.h"
#include "fuai/io/fabric_library.h"

int main() {
  const fuai::Fabric fabric = fuai::load_fabric("wool-tropical");
  const fuai::FabricLaws laws = fuai::make_fabric_laws(fabric);
  fuai::PlayState memory;
  const fuai::Response r = laws.bending[0].advance(100.0, memory);
  std::printf("%s: %.6f N at a curvature of 100 1/m\n", fabric.name.c_str(), r.stress);
  return r.stress > 0.0 ? 0 : 1;
}
