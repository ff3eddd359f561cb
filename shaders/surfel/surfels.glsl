// Vertex stage: from a vertex's number to a surfel and a position on it.
#include "include/patches.glsl"
#include "surfel/layout.h"

layout(std140, binding = RELIEF_SURFEL_BIND_FRAME) uniform SurfelFrameBlock {
  SurfelFrame surfel_frame;
};
layout(binding = RELIEF_SURFEL_TEXTURE_DRAWN) uniform usamplerBuffer drawn_surfels;
layout(binding = RELIEF_SURFEL_TEXTURE_CORNERS) uniform samplerBuffer corners;
layout(binding = RELIEF_SURFEL_TEXTURE_AXES) uniform samplerBuffer surfel_axes;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CURVED) != 0u
layout(binding = RELIEF_SURFEL_TEXTURE_BENDS) uniform samplerBuffer surfel_bends;
#endif

layout(location = RELIEF_SURFEL_UNIFORM_FIRST) uniform int first_drawn;
layout(location = RELIEF_SURFEL_UNIFORM_CORNER_BITS) uniform int corner_bits;

struct Surfel {
  int number;
  vec3 centre;  // from the eye
  vec3 u;       // as long as the radius
  vec3 v;
  float radius;
  vec3 bend;  // of its height in radii: xx, xy twice, yy; 0 of a polygon
};

// A vertex of a surfel. Positions are from the eye, world axes.
struct SurfelVertex {
  Surfel surfel;
  vec2 disc;  // in the disc, of radius 1
  vec3 position;
  vec3 normal;  // any length
};

SurfelVertex fetch_vertex() {
  int of_triangle = gl_VertexID / 3;
  int drawn = corner_bits == 0 ? of_triangle : gl_VertexID >> corner_bits;
  int corner = corner_bits == 0 ? gl_VertexID - 3 * of_triangle
                                : gl_VertexID & ((1 << corner_bits) - 1);
  uvec4 place = texelFetch(drawn_surfels, first_drawn + drawn);
  SurfelVertex vertex;
  vertex.surfel.number = int(place.w);
  vertex.surfel.centre = uintBitsToFloat(place.xyz);
  int row = vertex.surfel.number * kSurfelAxesRows;
  vec4 u = texelFetch(surfel_axes, row);
  vertex.surfel.u = u.xyz;
  vertex.surfel.v = texelFetch(surfel_axes, row + 1).xyz;
  vertex.surfel.radius = u.w;
  vertex.disc = texelFetch(corners, corner).xy;
  vertex.position =
      vertex.surfel.centre + vertex.disc.x * vertex.surfel.u + vertex.disc.y * vertex.surfel.v;
  vec3 normal = cross(vertex.surfel.u / u.w, vertex.surfel.v / u.w);
  vertex.normal = normal;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CURVED) != 0u
  vec3 bend = texelFetch(surfel_bends, vertex.surfel.number).xyz;
  vec2 slope = vec2(bend.x * vertex.disc.x + bend.y * vertex.disc.y,
                    bend.y * vertex.disc.x + bend.z * vertex.disc.y);
  vertex.position += (0.5 * u.w * dot(slope, vertex.disc)) * normal;
  vertex.normal -= (slope.x * vertex.surfel.u + slope.y * vertex.surfel.v) / u.w;
#endif
  return vertex;
}

// The ray to the centre of a surfel along its normal; of any length.
float facing_along(Surfel surfel) {
  vec3 normal = cross(surfel.u / surfel.radius, surfel.v / surfel.radius);
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return dot(normal, frame.ray_along.xyz);
#else
  return dot(normal, surfel.centre);
#endif
}

vec4 clip_position(vec3 position) {
  return surfel_frame.clip_from_eye * vec4(position, 1.0);
}

// What sets the depth values of a surfel in the first pass back along the rays: z_0 of section 3.2
// of [Textured surfels], along the ray to its centre.
float visibility_set_back(Surfel surfel) {
  float distance = length(surfel.centre);
  float offset = surfel_frame.rule.y * surfel.radius + surfel_frame.rule.z;
#if (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) != 0u
  return set_back_of(1.0, max(offset, kMinBlendingDepth * frame.ray_along.w));
#else
  offset = max(offset, kMinBlendingDepth * distance);
  float share = offset / max(distance, offset);  // a surfel about the eye is set back by no more
  return 1.0 / (1.0 + share);
#endif
}
