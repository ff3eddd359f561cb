// Pass 2: a surfel and what it contributes.
#include "surfel/surfels.glsl"
#include "surfel/clip_range.glsl"
#include "include/side.glsl"
#include "surfel/attributes.glsl"

layout(location = 0) out vec2 disc;
#if RELIEF_SURFEL_NEEDS_NORMAL
layout(location = 1) RELIEF_SURFEL_NORMAL_IS out vec3 normal;
#endif
#if RELIEF_SURFEL_HAS_TEXTURE
layout(binding = RELIEF_SURFEL_TEXTURE_TEXCOORDS) uniform samplerBuffer texcoords;
layout(location = 2) out vec2 texcoord;
layout(location = 4) flat out vec4 untextured;
#elif RELIEF_SURFEL_HAS_COLOUR
layout(binding = RELIEF_SURFEL_TEXTURE_COLOURS) uniform samplerBuffer colours;
layout(location = 2) flat out vec3 colour;
#endif
#if RELIEF_SURFEL_NEEDS_MATERIAL
layout(binding = RELIEF_SURFEL_TEXTURE_IDENTITIES) uniform usamplerBuffer identities;
layout(location = 3) flat out int material;
#endif

void main() {
  SurfelVertex vertex = fetch_vertex();
  disc = vertex.disc;
  write_clip_range(vertex.surfel.number);
  write_side(facing_along(vertex.surfel));
#if RELIEF_SURFEL_NEEDS_NORMAL
  normal = vertex.normal;
#endif
#if RELIEF_SURFEL_HAS_TEXTURE
  int row = vertex.surfel.number * kSurfelTexcoordRows;
  vec4 start = texelFetch(texcoords, row);
  texcoord = start.xy + disc.x * start.zw + disc.y * texelFetch(texcoords, row + 1).xy;
  untextured = texelFetch(texcoords, row + 2);
#elif RELIEF_SURFEL_HAS_COLOUR
  colour = texelFetch(colours, vertex.surfel.number).rgb;
#endif
#if RELIEF_SURFEL_NEEDS_MATERIAL
  material = int(texelFetch(identities, vertex.surfel.number).w);
#endif
  gl_Position = clip_position(vertex.position);
}
