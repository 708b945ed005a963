// Spells a mesh out.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/mesh_obj.h"

#include <algorithm>
#include <cstdio>

namespace fuai {

std::string mesh_obj(const SurfaceMesh& mesh, std::string_view name) {
  std::string object(name);
  std::ranges::replace_if(
      object, [](char c) { return c == ' ' || c == '\n' || c == '\t'; }, '_');
  std::string text =
      "# fuai; metres, z up; texture coordinates are weft and warp in metres\no " + object + "\n";
  char line[128];
  for (const Vec3& x : mesh.positions) {
    std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", x.x(), x.y(), x.z());
    text += line;
  }
  for (const Vec2& m : mesh.material) {
    std::snprintf(line, sizeof line, "vt %.9g %.9g\n", m.x(), m.y());
    text += line;
  }
  for (const auto& [a, b, c] : mesh.triangles) {
    std::snprintf(line, sizeof line, "f %d/%d %d/%d %d/%d\n", a + 1, a + 1, b + 1, b + 1, c + 1, c + 1);
    text += line;
  }
  return text;
}

}  // namespace fuai
