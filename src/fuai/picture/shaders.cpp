// The GLSL sources. Light is computed in linear light; the frame buffer encodes it to sRGB.
//
// Every light is parallel. A point p in the light's view has the coordinates (along two directions across the
// light, along the light) relative to a sphere (centre, radius) around everything that casts a shadow:
//   light_space(p, d) = ((p - c).a, (p - c).b, -(p - c).d) / R   in [-1, 1], third part grows away from the
//   light.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/shaders.h"

namespace fuai::shaders {

#define FUAI_LIGHT_SPACE                                                          \
  "uniform vec4 caster_sphere;\n" /* centre, radius [m] */                        \
  "vec3 light_space(vec3 p, vec3 d) {\n"                                          \
  "  vec3 helper = abs(d.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0);\n" \
  "  vec3 a = normalize(cross(helper, d)), b = cross(d, a);\n"                    \
  "  vec3 q = (p - caster_sphere.xyz) / caster_sphere.w;\n"                       \
  "  return vec3(dot(q, a), dot(q, b), -dot(q, d));\n"                            \
  "}\n"

const char* const kDepthVertex = "#version 330 core\n" FUAI_LIGHT_SPACE R"(
layout(location = 0) in vec3 position;
uniform vec3 direction;  // towards the light
void main() { gl_Position = vec4(light_space(position, direction), 1.0); }
)";

const char* const kDepthFragment = R"(#version 330 core
void main() {}
)";

const char* const kSurfaceVertex = "#version 330 core\n" FUAI_LIGHT_SPACE R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 material;
layout(location = 3) in vec2 value;
uniform mat4 view_projection;
uniform int ambient_count;
uniform vec4 ambient_light[64];  // direction towards the sky, strength
uniform sampler2DArrayShadow ambient_depth;
uniform float ambient_offset;    // [m]
out vec3 world;
out vec3 face_normal;
out vec2 cloth_place;
out vec2 map_place;
out vec2 ambient;                // light that arrives on the face and on the back

// Sum over the directions of strength * cosine * visibility, for both sides of the surface.
vec2 gather_ambient() {
  vec2 sum = vec2(0.0);
  for (int i = 0; i < ambient_count; ++i) {
    vec3 d = ambient_light[i].xyz;
    float cosine = dot(normal, d);
    // Start a little off the surface, on the side that sees this direction.
    vec3 q = light_space(position + sign(cosine) * ambient_offset * normal, d) * 0.5 + 0.5;
    float visible = texture(ambient_depth, vec4(q.xy, float(i), min(q.z, 1.0)));
    float light = ambient_light[i].w * abs(cosine) * visible;
    sum += cosine > 0.0 ? vec2(light, 0.0) : vec2(0.0, light);
  }
  return sum;
}

void main() {
  world = position;
  face_normal = normal;
  cloth_place = material;
  map_place = value;
  ambient = gather_ambient();
  gl_Position = view_projection * vec4(position, 1.0);
}
)";

const char* const kSurfaceFragment = "#version 330 core\n" FUAI_LIGHT_SPACE R"(
in vec3 world;
in vec3 face_normal;
in vec2 cloth_place;
in vec2 map_place;
in vec2 ambient;
uniform int kind;               // 0 cloth, 1 obstacle, 2 arrow, 3 ground
uniform vec4 eye;               // position (w = 1) or direction towards the eye (w = 0)
uniform vec3 face_colour;       // all colours here are linear
uniform vec3 back_colour;
uniform vec3 warp_colour;
uniform vec3 weft_colour;
uniform vec3 unknown_colour;
uniform int mapped;             // 1: colour from the map
uniform sampler2D colour_map;
uniform float thread_spacing;   // [m], 0: no lines
uniform vec4 ground_shape;      // centre x, centre y, radius, grid [m]
uniform vec3 key_direction;
uniform vec3 fill_direction;
uniform sampler2DShadow key_depth;
uniform float key_offset;       // [m]
uniform float key_texel;        // one texel in [0, 1]
out vec4 colour;

// Coverage of a pixel by lines at whole numbers; `share` is the part of the spacing that a line takes, at
// least about a pixel. Where lines come closer than three pixels or so they melt into their mean tint.
float lines(float coordinate, float footprint, float share) {
  float w = max(footprint, 1e-6);
  float seen = min(max(share, 1.1 * w), 0.35);
  float distance = abs(fract(coordinate - 0.5) - 0.5);
  float sharp = clamp((0.5 * seen + 0.5 * w - distance) / w, 0.0, 1.0);
  return mix(sharp, share, smoothstep(0.22, 0.45, w));
}

float key_visibility(vec3 p) {
  vec3 q = light_space(p, key_direction) * 0.5 + 0.5;
  float sum = 0.0;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i)
      sum += texture(key_depth, vec3(q.xy + 1.3 * key_texel * vec2(i, j), min(q.z, 1.0)));
  return sum / 25.0;
}

// Light on a white surface that faces n: about 1 when nothing shades it and it faces the key light.
float light_on(vec3 n, float soft, vec3 to_eye) {
  // Where no sky is seen, light still arrives by way of other surfaces.
  soft = 0.22 + 0.78 * soft;
  float key = max(dot(n, key_direction), 0.0);
  if (key > 0.0) key *= key_visibility(world + key_offset * n);
  float fill = max(dot(n, fill_direction), 0.0) * soft;
  float sheen = pow(1.0 - max(dot(n, to_eye), 0.0), 3.0) * soft;
  return 0.60 * key + 0.16 * fill + 0.40 * soft + 0.06 * sheen;
}

vec3 cloth_albedo(bool front) {
  vec2 place = thread_spacing > 0.0 ? cloth_place / thread_spacing : vec2(0.5);
  vec2 footprint = fwidth(place);
  // Lines of constant weft coordinate run along the warp.
  float warp = lines(place.x, footprint.x, 0.08), weft = lines(place.y, footprint.y, 0.08);
  if (thread_spacing <= 0.0) warp = weft = 0.0;
  vec3 own = front ? face_colour : back_colour;
  if (mapped == 0) return mix(mix(own, warp_colour, 0.75 * warp), weft_colour, 0.75 * weft);
  own = map_place.y > 0.999 ? texture(colour_map, vec2(map_place.x, 0.5)).rgb : unknown_colour;
  return own * (1.0 - 0.30 * max(warp, weft));
}

void main() {
  bool front = gl_FrontFacing;
  vec3 n = normalize(front ? face_normal : -face_normal);
  float soft = front ? ambient.x : ambient.y;
  vec3 to_eye = normalize(eye.xyz - eye.w * world);
  vec3 cloth = cloth_albedo(front);
  vec2 grid_place = world.xy / max(ground_shape.w, 1e-6);
  vec2 grid_footprint = fwidth(grid_place);
  if (kind == 2) {
    // An arrow keeps its colour whatever the light.
    colour = vec4(face_colour * (0.60 + 0.40 * max(dot(n, normalize(to_eye + vec3(0.0, 0.0, 0.6))), 0.0)), 1.0);
    return;
  }
  float light = light_on(n, soft, to_eye);
  if (kind == 0) {
    // Values are read off the colour: the light models them less.
    colour = vec4(cloth * (mapped == 1 ? mix(1.0, light, 0.65) : light), 1.0);
  } else if (kind == 1) {
    colour = vec4(face_colour * light, 1.0);
  } else {
    float grid = 0.0;
    if (ground_shape.w > 0.0)
      grid = max(lines(grid_place.x, grid_footprint.x, 0.01), lines(grid_place.y, grid_footprint.y, 0.01));
    float alpha = 1.0 - smoothstep(0.55, 1.0, distance(world.xy, ground_shape.xy) / ground_shape.z);
    colour = vec4(face_colour * light * (1.0 - 0.35 * grid) * alpha, alpha);
  }
}
)";

#undef FUAI_LIGHT_SPACE

}  // namespace fuai::shaders
