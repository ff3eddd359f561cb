// From the outputs of a view to colours that show one of them.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_INSPECTED_COLOUR) uniform sampler2D picture;
layout(binding = RELIEF_TEXTURE_INSPECTED_NORMAL) uniform sampler2D normals;
layout(binding = RELIEF_TEXTURE_INSPECTED_UV) uniform sampler2D grid_positions;
layout(binding = RELIEF_TEXTURE_INSPECTED_PATCH) uniform usampler2D patches;  // id + 1
layout(binding = RELIEF_TEXTURE_INSPECTED_LEVELS) uniform usamplerBuffer levels;
layout(binding = RELIEF_TEXTURE_INSPECTION_COLOURS) uniform sampler2D colours;
layout(std430, binding = RELIEF_BIND_FRAGMENT_COUNT) readonly buffer FragmentCount {
  uint counts_a_row;
  uint fragment_counts[];
};

layout(location = RELIEF_UNIFORM_INSPECTION) uniform int inspection;
layout(location = RELIEF_UNIFORM_INSPECTED_PART) uniform ivec3 part;  // left, bottom, samples a side
layout(location = RELIEF_UNIFORM_TOWARD_EYE) uniform vec3 toward_eye;
layout(location = RELIEF_UNIFORM_SCALE_END) uniform float scale_end;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

// Light on what faces the side, where 1 is on what faces the eye: shape stays visible in any colour.
const float kDarkest = 0.25;

// Pixels: half the width of a line, and the radius of a sample's dot as a share of its cell.
const float kHalfLine = 0.5;
const float kDot = 0.22;
const float kSmallestDot = 1.3;
const float kLargestDot = 7.0;

// Cells of fewer pixels than the first show no lines or samples of their own, from the second on all.
const vec2 kSeenCell = vec2(3.0, 7.0);

const vec3 kSurface = vec3(0.55);
const vec3 kLine = vec3(0.01, 0.03, 0.12);
const vec3 kSample = vec3(0.9, 0.25, 0.01);

vec3 scale_colour(int index) {
  return texelFetch(colours, ivec2(index, 0), 0).rgb;
}

float light_at(ivec2 at) {
  vec3 normal = texelFetch(normals, at, 0).xyz;
  float size = length(normal);
  if (size == 0.0) return 1.0;
  return mix(kDarkest, 1.0, abs(dot(normal, toward_eye)) / size);
}

// How grid coordinates change toward the next sample of the picture, on the same patch; 0 if none is.
vec2 change_of(ivec2 at, ivec2 along, uint patch_number, vec2 here) {
  for (int side = 1; side >= -1; side -= 2) {
    ivec2 beside = at + side * along;
    if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, textureSize(patches, 0)))) continue;
    if (texelFetch(patches, beside, 0).x != patch_number) continue;
    return float(side) * (texelFetch(grid_positions, beside, 0).xy - here);
  }
  return vec2(0.0);
}

// Lines between cells, or a dot at each sample; `shade` is the surface's light.
vec3 grid_colour(ivec2 at, uint patch_number, float light) {
  vec2 here = texelFetch(grid_positions, at, 0).xy;
  mat2 change = mat2(change_of(at, ivec2(1, 0), patch_number, here), change_of(at, ivec2(0, 1), patch_number, here));
  vec3 surface = light * kSurface;
  vec2 cells_a_pixel = vec2(length(vec2(change[0].x, change[1].x)), length(vec2(change[0].y, change[1].y)));
  if (min(cells_a_pixel.x, cells_a_pixel.y) == 0.0) return surface;
  float side = float(part.z);
  vec2 seen = smoothstep(kSeenCell.xx, kSeenCell.yy, 1.0 / (side * cells_a_pixel));
  vec2 off = here - round(here);
  if (inspection == kInspectCells) {
    vec2 covered = seen * clamp(side * kHalfLine + 0.5 - abs(off) / cells_a_pixel, 0.0, 1.0);
    return mix(surface, kLine, max(covered.x, covered.y));
  }
  float area = determinant(change);
  if (area == 0.0) return surface;
  // Round on the screen, whatever way the surface leans.
  float away = length(inverse(change) * off);
  float radius = side * clamp(kDot / (side * max(cells_a_pixel.x, cells_a_pixel.y)), kSmallestDot, kLargestDot);
  return mix(surface, kSample, min(seen.x, seen.y) * clamp(radius + 0.5 - away, 0.0, 1.0));
}

vec4 colour_of(ivec2 at) {
  vec4 background = vec4(texelFetch(picture, at, 0).rgb, 0.0);
  if (inspection == kInspectOverdraw) {
    uint count = fragment_counts[uint(at.y) * counts_a_row + uint(at.x)];
    if (count == 0u) return background;
    float share = min(float(count) / scale_end, 1.0);
    return vec4(scale_colour(int(share * float(kInspectionColours - 1) + 0.5)), 1.0);
  }
  uint patch_number = texelFetch(patches, at, 0).x;
  if (patch_number == 0u) return background;
  float light = light_at(at);
  if (inspection == kInspectNormals) {
    // What sRGB encodes is (n + 1) / 2 as it is.
    vec3 encoded = 0.5 + 0.5 * normalize(texelFetch(normals, at, 0).xyz);
    return vec4(mix(encoded / 12.92, pow((encoded + 0.055) / 1.055, vec3(2.4)), greaterThan(encoded, vec3(0.04045))),
                1.0);
  }
  if (inspection == kInspectPatches)
    return vec4(light * scale_colour(int((patch_number - 1u) % uint(kInspectionColours))), 1.0);
  if (inspection == kInspectLevels) {
    uint level = texelFetch(levels, int(patch_number) - 1).x;
    return vec4(light * scale_colour(int(min(level, uint(kInspectionColours - 1)))), 1.0);
  }
  return vec4(grid_colour(at, patch_number, light), 1.0);
}

void main() {
  ivec2 first = part.z * (ivec2(gl_FragCoord.xy) - part.xy);
  vec4 sum = vec4(0.0);
  for (int y = 0; y < part.z; ++y) {
    for (int x = 0; x < part.z; ++x) sum += colour_of(first + ivec2(x, y));
  }
  out_colour = sum / float(part.z * part.z);
}
