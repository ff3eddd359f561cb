// The attribute maps of patches, for the stage that reads them.
#include "include/patches.glsl"

#define RELIEF_NEEDS_NORMAL                                                             \
  ((RELIEF_FEATURES & (RELIEF_FEATURE_LIT | RELIEF_FEATURE_MIRROR | RELIEF_FEATURE_GLASS | \
                       RELIEF_FEATURE_OUT_NORMAL)) != 0u)

#if RELIEF_NEEDS_NORMAL
layout(binding = RELIEF_TEXTURE_NORMALS) uniform sampler2DArray normal_maps;
#endif
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(binding = RELIEF_TEXTURE_COLOURS) uniform sampler2DArray colour_maps;
#endif

// Bilinear lookup at grid coordinates `uv`; `map` says where the patch's map lies in the array.
vec3 position_in_maps(sampler2DArray maps, ivec4 map, vec2 uv) {
  vec2 texel = vec2(map.xy) + uv * float(map.w) + 0.5;
  return vec3(texel / vec2(textureSize(maps, 0).xy), float(map.z));
}

vec4 look_up(sampler2DArray maps, ivec4 map, vec2 uv) {
  return textureLod(maps, position_in_maps(maps, map, uv), 0.0);
}

// Whether maps are averaged over a pixel's footprint.
#define RELIEF_NEEDS_FOOTPRINT \
  ((RELIEF_FEATURES & (RELIEF_FEATURE_FINE_COLOURS | RELIEF_FEATURE_FINE_NORMALS)) != 0u)

#if RELIEF_NEEDS_NORMAL
// From half its stereographic coordinates, which bilinear lookups interpolate smoothly; octahedral
// ones have creases along the axes, where a mirror would show them.
vec3 unit_from_stereographic(vec2 half_stereographic) {
  vec2 p = 2.0 * half_stereographic;
  return vec3(2.0 * p, 1.0 - dot(p, p)) / (1.0 + dot(p, p));
}
#endif

#if RELIEF_NEEDS_FOOTPRINT
// Where a map is looked up for a pixel: `count` lookups along `along` (grid coordinates), at a mip
// level.
struct Lookups {
  vec2 along;
  float count;
  float level;
};

// The mean over a pixel's footprint, whose sides are `footprint.xy` and `.zw` in grid coordinates:
// trilinear lookups along the longer one, at the mip level of the shorter (McCormack et al. 1999,
// "Feline"). By the shader and not by the sampler, so that it is the same everywhere and ends where
// the map beside begins: a patch has two cells of its own around it. `texels`: a cell.
Lookups lookups_over(PatchInfo info, vec2 uv, vec4 footprint, float texels) {
  vec2 room = min(uv - info.extent.x, info.extent.yz - uv) + 2.0 / info.extent.w;
  float longer = length(footprint.xy);
  float shorter = length(footprint.zw);
  vec2 along = longer > shorter ? footprint.xy : footprint.zw;
  if (shorter > longer) {
    float other = longer;
    longer = shorter;
    shorter = other;
  }
  // In this form a footprint that is NaN becomes none.
  float kept = longer < 1e6 ? min(1.0, min(room.x, room.y) / max(longer, 1e-6)) : 0.0;
  along *= kept;
  longer *= kept * texels;
  shorter *= kept * texels;
  float count = clamp(ceil(longer / max(shorter, 1.0)), 1.0, kMaxFootprintLookups);
  return Lookups(along, count, log2(max(longer / count, 1.0)));
}
#endif

#if (RELIEF_FEATURES & RELIEF_FEATURE_FINE_COLOURS) != 0u
vec3 look_up_colour(PatchInfo info, vec2 uv, vec4 footprint) {
  Lookups lookups = lookups_over(info, uv, footprint, float(info.colours.w));
  vec3 sum = vec3(0.0);
  for (float k = 0.5; k < lookups.count; k += 1.0) {
    vec2 position = uv + (k / lookups.count - 0.5) * lookups.along;
    sum += textureLod(colour_maps, position_in_maps(colour_maps, info.colours, position), lookups.level).rgb;
  }
  return sum / lookups.count;
}
#endif

#if RELIEF_NEEDS_NORMAL
// Of a patch, in its frame, unit; `footprint` is of no account without fine maps.
vec3 look_up_normal(PatchInfo info, vec2 uv, vec4 footprint) {
#if (RELIEF_FEATURES & RELIEF_FEATURE_FINE_NORMALS) != 0u
  Lookups lookups = lookups_over(info, uv, footprint, float(info.normals.w));
  vec3 sum = vec3(0.0);
  for (float k = 0.5; k < lookups.count; k += 1.0) {
    vec2 position = uv + (k / lookups.count - 0.5) * lookups.along;
    sum += unit_from_stereographic(
        textureLod(normal_maps, position_in_maps(normal_maps, info.normals, position), lookups.level).xy);
  }
  // Means of unit vectors are shorter; those that cancel each other leave the patch's own.
  float squared = dot(sum, sum);
  return squared > 1e-6 ? sum * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
#else
  return unit_from_stereographic(look_up(normal_maps, info.normals, uv).xy);
#endif
}
#endif

vec3 to_world(PatchInfo info, vec3 v) {
  return info.axis_u.xyz * v.x + info.axis_v.xyz * v.y + info.axis_n.xyz * v.z;
}
