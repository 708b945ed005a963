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
uniform vec2 yarn_pitch;        // distance of the yarns of warp and weft [m], 0: no yarns
uniform int structure;          // WeaveStructure: 0 plain, 1 twill 2/2, 2 satin of five, 3 knit
uniform vec2 texture_size;      // width and height of the picture on the cloth [m], 0: none
uniform sampler2D cloth_texture;
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

// Whether the warp lies above the weft at a crossing, seen from the face.
bool warp_above(vec2 crossing) {
  // Halves are added so that no quotient lies on a whole number, where drivers round as they like.
  if (structure == 1) return mod(crossing.x - crossing.y + 0.5, 4.0) < 2.0;
  if (structure == 2) return mod(crossing.x + 2.0 * crossing.y + 0.5, 5.0) > 1.0;
  return mod(crossing.x + crossing.y + 0.5, 2.0) < 1.0;
}

// A saw tooth, which runs from -1/2 to 1/2 between seams, as a pixel of this footprint sees it.
vec2 seen_tooth(vec2 g, vec2 footprint) {
  vec2 half_pixel = clamp(0.5 * footprint, 1e-3, 0.25), g0 = abs(g);
  return sign(g) * min(g0, (0.5 - g0) * (0.5 - half_pixel) / half_pixel);
}

// Height of the yarns above their mean, 1 from the seam to the crown of a yarn, and its slopes along weft and
// warp [1/yarn]. Yarns are parabolas across, and dive at the ends of their floats, less steeply than they are
// round: that makes a crossing longer than wide. All means are zero.
vec3 woven(vec2 place, vec2 footprint, bool front) {
  vec2 crossing = floor(place), f = place - crossing - 0.5;
  bool warp = warp_above(crossing) == front;
  vec2 g = warp ? f : f.yx;  // across and along the yarn on top
  vec2 next = (g.y < 0.0 ? -1.0 : 1.0) * (warp ? vec2(0.0, 1.0) : vec2(1.0, 0.0));
  const float depth = 0.45;
  float dives = (warp_above(crossing + next) == front) == warp ? 0.0 : depth;
  // Part of the half yarns that dive: all, every second, two of five.
  float diving = structure == 1 ? 0.5 : structure == 2 ? 0.4 : 1.0;
  vec2 slope = -8.0 * seen_tooth(g, warp ? footprint : footprint.yx) * vec2(1.0, dives);
  return vec3((1.0 + depth * diving) / 3.0 - 4.0 * (g.x * g.x + dives * g.y * g.y), warp ? slope : slope.yx);
}

// The same of a jersey: two legs a wale, which lean apart; on the back the arcs between them.
vec3 knitted(vec2 place, vec2 footprint, bool front) {
  float x = fract(front ? place.x : place.x + 0.5) - 0.5, side = x < 0.0 ? -1.0 : 1.0;
  float lean = front ? 1.2 : -0.6;
  vec2 leg = vec2(2.0 * abs(x) - 0.5, fract(place.y - lean * abs(x)) - 0.5);  // across and along it
  vec2 slope = -8.0 * seen_tooth(leg, footprint);
  return vec3(2.0 / 3.0 - 4.0 * dot(leg, leg), side * (2.0 * slope.x - lean * slope.y), slope.y);
}

// How yarns tilt the surface (what is added to the normal), and in the fourth part how far the place lies above
// the mean; zero where a yarn is hardly larger than a pixel.
vec4 yarn_relief(vec3 n, bool front) {
  vec3 along_x = dFdx(world), along_y = dFdy(world);
  vec2 place_x = dFdx(cloth_place), place_y = dFdy(cloth_place);
  vec2 footprint = (abs(place_x) + abs(place_y)) / yarn_pitch;
  // A leg of a knit is half a wale wide.
  if (structure == 3) footprint.x *= 2.0;
  float seen = 1.0 - smoothstep(0.2, 0.5, max(footprint.x, footprint.y));
  if (seen <= 0.0) return vec4(0.0);
  vec2 place = cloth_place / yarn_pitch;
  vec3 yarn = structure == 3 ? knitted(place, footprint, front) : woven(place, footprint, front);
  // Gradients of the material coordinates along the surface [1], from their derivatives on the screen.
  vec3 a = cross(along_y, n), b = cross(n, along_x);
  float area = dot(along_x, a);
  if (abs(area) < 1e-20) return vec4(0.0);
  vec3 weft = (a * place_x.x + b * place_y.x) / area, warp = (a * place_x.y + b * place_y.y) / area;
  // Height of a yarn in parts of its pitch: what keeps tilts below 0.85.
  float relief = structure == 3 ? 0.06 : 0.19;
  vec3 tilt = -relief * (yarn.y * weft + yarn.z * warp);
  // Only cloth that is pressed together, as a picture of a failed step may show, has steeper yarns.
  return seen * vec4(tilt * min(1.0, 0.85 / max(length(tilt), 1e-6)), yarn.x);
}

// A light's cosine with the tilt of the yarns: its mean over the yarns is that without them, because no yarn
// takes away more than there is (tilts reach 0.85).
float tilted(float cosine, float tilt) { return cosine + min(cosine / 0.85, 1.0) * tilt; }

// Light on a white surface that faces n: about 1 when nothing shades it and it faces the key light.
float light_on(vec3 n, float soft, vec3 to_eye, vec4 yarns) {
  // Where no sky is seen, light still arrives by way of other surfaces; less of it between yarns.
  soft = (0.22 + 0.78 * soft) * (1.0 + 0.25 * yarns.w);
  float key = max(dot(n, key_direction), 0.0);
  if (key > 0.0) key = tilted(key, dot(yarns.xyz, key_direction)) * key_visibility(world + key_offset * n);
  float fill = max(dot(n, fill_direction), 0.0);
  fill = tilted(fill, dot(yarns.xyz, fill_direction)) * soft;
  // Rounding makes the cosine more than 1 at times, and a power of less than nothing a black pixel.
  float sheen = pow(clamp(1.0 - dot(n, to_eye), 0.0, 1.0), 3.0) * soft;
  return 0.60 * key + 0.16 * fill + 0.40 * soft + 0.06 * sheen;
}

vec3 cloth_albedo(bool front) {
  vec2 place = thread_spacing > 0.0 ? cloth_place / thread_spacing : vec2(0.5);
  vec2 footprint = fwidth(place);
  // Lines of constant weft coordinate run along the warp.
  float warp = lines(place.x, footprint.x, 0.08), weft = lines(place.y, footprint.y, 0.08);
  if (thread_spacing <= 0.0) warp = weft = 0.0;
  vec3 own = front ? face_colour : back_colour;
  if (texture_size.x > 0.0) {
    // Rows of a picture count downward, the warp coordinate upward.
    vec4 picture = texture(cloth_texture, cloth_place * vec2(1.0, -1.0) / texture_size);
    own = mix(own, picture.rgb, picture.a);
  }
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
  vec4 yarns = kind == 0 && yarn_pitch.x > 0.0 ? yarn_relief(n, front) : vec4(0.0);
  float light = light_on(n, soft, to_eye, yarns);
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
