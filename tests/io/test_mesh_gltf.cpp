// Meshes as binary glTF, taken apart again by the rules of the specification.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/mesh_gltf.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "fuai/core/error.h"

using namespace fuai;
using Json = nlohmann::json;

namespace {

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  REQUIRE(at + 4 <= bytes.size());
  std::memcpy(&number, bytes.data() + at, 4);
  return number;
}

/// The two chunks of a file.
struct Glb {
  Json json;
  std::string binary;
};

Glb parse(const std::string& file) {
  CHECK(file.substr(0, 4) == "glTF");
  CHECK(number_at(file, 4) == 2);
  CHECK(number_at(file, 8) == file.size());
  const std::size_t json_size = number_at(file, 12);
  CHECK(json_size % 4 == 0);
  CHECK(file.substr(16, 4) == "JSON");
  const std::size_t second = 20 + json_size;
  const std::size_t binary_size = number_at(file, second);
  CHECK(binary_size % 4 == 0);
  CHECK(file.substr(second + 4, 4) == std::string("BIN\0", 4));
  CHECK(second + 8 + binary_size == file.size());
  return {Json::parse(file.substr(20, json_size)), file.substr(second + 8)};
}

/// The numbers of an accessor.
template <class T>
std::vector<T> numbers(const Glb& glb, std::size_t accessor) {
  const Json& a = glb.json["accessors"][accessor];
  const Json& view = glb.json["bufferViews"][a["bufferView"].get<std::size_t>()];
  const std::size_t width = a["type"] == "VEC3" ? 3 : a["type"] == "VEC2" ? 2 : 1;
  const std::size_t count = width * a["count"].get<std::size_t>();
  const auto offset = view["byteOffset"].get<std::size_t>();
  CHECK(a["componentType"] == (std::is_same_v<T, float> ? 5126 : 5125));
  CHECK(view["byteLength"] == count * sizeof(T));
  CHECK(offset % 4 == 0);
  REQUIRE(offset + count * sizeof(T) <= glb.json["buffers"][0]["byteLength"].get<std::size_t>());
  std::vector<T> values(count);
  std::memcpy(values.data(), glb.binary.data() + offset, count * sizeof(T));
  return values;
}

SurfaceMesh bump() {
  std::vector<Vec3> positions;
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      positions.emplace_back(0.01 * column, 0.01 * row, row == 1 && column == 1 ? 0.1 / 3.0 : -0.002);
  return make_lattice_mesh(4, 3, 0.01, positions);
}

}  // namespace

TEST_SUITE("unit") {
  TEST_CASE("chunks, counts, bounds and alignment are those of the specification") {
    const SurfaceMesh mesh = bump();
    for (const char* name : {"wool", "wool ", "wool 1", "wool 12"}) {  // every length of the padding
      GltfOptions options;
      options.generator = "fuai test";
      const Glb glb = parse(mesh_glb(mesh, name, options));
      CHECK(glb.json["asset"]["version"] == "2.0");
      CHECK(glb.json["asset"]["generator"] == "fuai test");
      CHECK(glb.json["buffers"][0]["byteLength"].get<std::size_t>() <= glb.binary.size());
      CHECK(!glb.json["buffers"][0].contains("uri"));
      const Json& shape = glb.json["meshes"][0];
      CHECK(shape["extras"]["fabric"] == name);
      CHECK(shape["extras"]["position_unit"] == "m");
      CHECK(glb.json["materials"][0]["doubleSided"] == true);
      CHECK(shape["primitives"][0]["material"] == 0);
    }
  }

  TEST_CASE("the numbers are the mesh's") {
    const SurfaceMesh mesh = bump();
    const std::string fabric = "絹 \"silk\"";
    const Glb glb = parse(mesh_glb(mesh, fabric));
    const Json& primitive = glb.json["meshes"][0]["primitives"][0];
    CHECK(glb.json["meshes"][0]["name"] == fabric);
    const Json& attributes = primitive["attributes"];
    const auto at = attributes["POSITION"].get<std::size_t>();
    const std::vector<float> positions = numbers<float>(glb, at);
    const std::vector<float> normals = numbers<float>(glb, attributes["NORMAL"].get<std::size_t>());
    const std::vector<float> texture = numbers<float>(glb, attributes["TEXCOORD_0"].get<std::size_t>());
    REQUIRE(positions.size() == 3 * mesh.positions.size());
    REQUIRE(normals.size() == positions.size());
    REQUIRE(texture.size() == 2 * mesh.positions.size());
    const std::vector<Vec3> expected = vertex_normals(mesh);
    std::vector<float> low(3, 1e9F), high(3, -1e9F);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      float square = 0.0F;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto c = static_cast<Eigen::Index>(i);
        CHECK(positions[3 * v + i] == static_cast<float>(mesh.positions[v][c]));
        CHECK(normals[3 * v + i] == static_cast<float>(expected[v][c]));
        square += normals[3 * v + i] * normals[3 * v + i];
        low[i] = std::min(low[i], positions[3 * v + i]);
        high[i] = std::max(high[i], positions[3 * v + i]);
      }
      CHECK(std::abs(square - 1.0F) < 1e-6F);  // rounded to float
      CHECK(texture[2 * v] == static_cast<float>(mesh.material[v].x()));
      CHECK(texture[2 * v + 1] == static_cast<float>(-mesh.material[v].y()));
    }
    CHECK(glb.json["accessors"][at]["min"].get<std::vector<float>>() == low);
    CHECK(glb.json["accessors"][at]["max"].get<std::vector<float>>() == high);
    const std::vector<std::uint32_t> indices =
        numbers<std::uint32_t>(glb, primitive["indices"].get<std::size_t>());
    REQUIRE(indices.size() == 3 * mesh.triangles.size());
    for (std::size_t i = 0; i < indices.size(); ++i)
      CHECK(static_cast<int>(indices[i]) == mesh.triangles[i / 3][i % 3]);
    // The quarter turn takes the cloth's up, z, to glTF's up, y: v' = v + 2 w (q x v) + 2 q x (q x v).
    const auto r = glb.json["nodes"][0]["rotation"].get<std::vector<double>>();
    const double up_y = -2.0 * r[0] * r[3], up_z = 1.0 - 2.0 * r[0] * r[0];
    CHECK(up_y == doctest::Approx(1.0));
    CHECK(std::abs(up_z) < 1e-15);
  }

  TEST_CASE("what is no mesh is refused") {
    SurfaceMesh mesh = bump();
    mesh.positions[3].z() = std::numeric_limits<double>::infinity();
    CHECK_THROWS_AS(mesh_glb(mesh, "wool"), Error);
    mesh = bump();
    mesh.material.pop_back();
    CHECK_THROWS_AS(mesh_glb(mesh, "wool"), Error);
    mesh = bump();
    mesh.triangles.clear();
    CHECK_THROWS_AS(mesh_glb(mesh, "wool"), Error);
  }
}
