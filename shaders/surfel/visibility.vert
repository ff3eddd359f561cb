// Pass 1: a surfel, set back.
#include "surfel/surfels.glsl"
#include "surfel/clip_range.glsl"
#include "include/side.glsl"

layout(location = 0) out vec2 disc;
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH | RELIEF_FEATURE_MIXED)) != 0u
layout(binding = RELIEF_SURFEL_TEXTURE_IDENTITIES) uniform usamplerBuffer identities;
layout(location = 1) flat out uvec4 identity;  // grid coordinates (bits), patch id + 1, material
#endif

void main() {
  SurfelVertex vertex = fetch_vertex();
  disc = vertex.disc;
  write_clip_range(vertex.surfel.number);
  write_side(facing_along(vertex.surfel));
#if (RELIEF_FEATURES & (RELIEF_FEATURE_OUT_UV | RELIEF_FEATURE_OUT_PATCH | RELIEF_FEATURE_MIXED)) != 0u
  identity = texelFetch(identities, vertex.surfel.number);
#endif
  gl_Position = clip_position(vertex.position);
  gl_Position.z = set_back(gl_Position.z, visibility_set_back(vertex.surfel));
}
