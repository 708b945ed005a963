// Packs a mesh into one binary buffer and describes it in JSON.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/mesh_gltf.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <numbers>

#include "fuai/core/error.h"

namespace fuai {
namespace {

using Json = nlohmann::ordered_json;

static_assert(std::endian::native == std::endian::little, "glTF is little-endian");

// Numbers of the specification.
constexpr int kFloat = 5126, kUnsignedInt = 5125, kArrayBuffer = 34962, kElementBuffer = 34963;
constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJsonChunk = 0x4E4F534A, kBinChunk = 0x004E4942;

void put_bytes(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

void put_number(std::string& bytes, std::uint32_t number) { put_bytes(bytes, &number, sizeof number); }

/// The buffer with what describes its parts.
struct Buffer {
  std::string bytes;
  Json views = Json::array(), accessors = Json::array();

  /// Adds a view of what was appended since `begin` and an accessor of it. @return number of the accessor
  std::size_t describe(std::size_t begin, int target, int component, const char* type, std::size_t count) {
    views.push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bytes.size() - begin}, {"target", target}});
    accessors.push_back(
        {{"bufferView", views.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}});
    return accessors.size() - 1;
  }

  template <class Vector>
  std::size_t add(const std::vector<Vector>& vectors, const char* type) {
    const std::size_t begin = bytes.size();
    for (const Vector& v : vectors) {
      for (int i = 0; i < v.size(); ++i) {
        const auto number = static_cast<float>(v[i]);
        put_bytes(bytes, &number, sizeof number);
      }
    }
    return describe(begin, kArrayBuffer, kFloat, type, vectors.size());
  }
};

void check(const SurfaceMesh& mesh) {
  const bool finite = std::ranges::all_of(mesh.positions, [](const Vec3& x) { return x.allFinite(); });
  if (mesh.positions.empty() || mesh.triangles.empty() || mesh.material.size() != mesh.positions.size() ||
      !finite)
    throw Error(ErrorKind::kUsage, "this mesh cannot be written as glTF", {},
                "it needs triangles, finite positions and a material point for each");
}

/// Bounds as the file has them: of the single-precision numbers.
Json bound(const std::vector<Vec3>& positions, bool upper) {
  Json corner = Json::array();
  for (int i = 0; i < 3; ++i) {
    const auto less = [i](const Vec3& a, const Vec3& b) { return a[i] < b[i]; };
    const auto& x =
        upper ? *std::ranges::max_element(positions, less) : *std::ranges::min_element(positions, less);
    corner.push_back(static_cast<float>(x[i]));
  }
  return corner;
}

std::size_t add_triangles(const SurfaceMesh& mesh, Buffer& buffer) {
  const std::size_t begin = buffer.bytes.size();
  for (const auto& triangle : mesh.triangles)
    for (const int vertex : triangle) put_number(buffer.bytes, static_cast<std::uint32_t>(vertex));
  return buffer.describe(begin, kElementBuffer, kUnsignedInt, "SCALAR", 3 * mesh.triangles.size());
}

Json describe(const SurfaceMesh& mesh, const std::string& fabric, const GltfOptions& options,
              Buffer& buffer) {
  const std::size_t positions = buffer.add(mesh.positions, "VEC3");
  buffer.accessors[positions]["min"] = bound(mesh.positions, false);
  buffer.accessors[positions]["max"] = bound(mesh.positions, true);
  const std::size_t normals = buffer.add(vertex_normals(mesh), "VEC3");
  std::vector<Vec2> texture;
  for (const Vec2& m : mesh.material) texture.emplace_back(m.x(), -m.y());
  const std::size_t coordinates = buffer.add(texture, "VEC2");
  const std::size_t indices = add_triangles(mesh, buffer);
  const double half = std::numbers::sqrt2 / 2.0;  // a quarter turn about x: z up becomes y up
  Json document;
  document["asset"] = {{"version", "2.0"}, {"generator", options.generator}};
  document["scene"] = 0;
  document["scenes"] = Json::array({{{"nodes", {0}}}});
  document["nodes"] = Json::array({{{"mesh", 0}, {"name", fabric}, {"rotation", {-half, 0.0, 0.0, half}}}});
  document["meshes"] = Json::array(
      {{{"name", fabric},
        {"primitives",
         Json::array(
             {{{"attributes", {{"POSITION", positions}, {"NORMAL", normals}, {"TEXCOORD_0", coordinates}}},
               {"indices", indices},
               {"material", 0},
               {"mode", 4}}})},
        {"extras",
         {{"fabric", fabric},
          {"position_unit", "m"},
          {"texture_coordinates", "u = weft, v = -warp"},
          {"texture_unit", "m"},
          {"face", "counter-clockwise"}}}}});
  document["materials"] = Json::array(
      {{{"name", fabric},
        {"doubleSided", true},
        {"pbrMetallicRoughness",
         {{"baseColorFactor", options.colour}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.9}}}}});
  document["buffers"] = Json::array({{{"byteLength", buffer.bytes.size()}}});
  document["bufferViews"] = buffer.views;
  document["accessors"] = buffer.accessors;
  return document;
}

void put_chunk(std::string& file, std::uint32_t kind, const std::string& content, char filling) {
  const std::size_t padded = (content.size() + 3) / 4 * 4;
  put_number(file, static_cast<std::uint32_t>(padded));
  put_number(file, kind);
  file += content;
  file.append(padded - content.size(), filling);
}

}  // namespace

std::string mesh_glb(const SurfaceMesh& mesh, const std::string& fabric, const GltfOptions& options) {
  check(mesh);
  Buffer buffer;
  const std::string json =
      describe(mesh, fabric, options, buffer).dump(-1, ' ', false, Json::error_handler_t::replace);
  std::string chunks;
  put_chunk(chunks, kJsonChunk, json, ' ');
  put_chunk(chunks, kBinChunk, buffer.bytes, '\0');
  std::string file;
  put_number(file, kMagic);
  put_number(file, kVersion);
  put_number(file, static_cast<std::uint32_t>(3 * sizeof(std::uint32_t) + chunks.size()));
  return file + chunks;
}

}  // namespace fuai
