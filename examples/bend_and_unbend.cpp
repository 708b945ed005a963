// Bends a measured fabric and bends it back: the moment remembers.
// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include "fuai/fabric/laws.h"
#include "fuai/io/fabric_library.h"

int main() {
  const fuai::Fabric wool = fuai::load_fabric("wool-tropical");
  const fuai::FabricLaws laws = fuai::make_fabric_laws(wool);  // bending, shear, tension
  fuai::PlayState memory;                           // the friction memory of one place of the cloth
  for (double curvature : {100.0, 250.0, 100.0}) {  // 1/m: bend, bend further, bend back
    const fuai::Response r = laws.bending[0].advance(curvature, memory);
    std::printf("%5.0f 1/m  %.3e N  tangent %.3e N m\n", curvature, r.stress, r.tangent);
  }
}
