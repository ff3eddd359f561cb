// A square of a grid's nodes with the same z, as two triangles. (A point would be one vertex, but
// llvmpipe sets points of an even size off by a row.)
#extension GL_ARB_shader_viewport_layer_array : require
#include "include/shared.h"
#include "volume/layout.h"

layout(std140, binding = RELIEF_VOLUME_BIND_NODES) uniform NodesBlock { VolumeNodes shading; };
/// First node along x and y, z.
layout(binding = RELIEF_VOLUME_TEXTURE_SQUARES) uniform isamplerBuffer squares;

void main() {
  ivec3 square = texelFetch(squares, gl_VertexID / 6).xyz;
  gl_Layer = square.z;
  int corner = gl_VertexID % 6;
  // Corners 0, 1, 2 and 2, 1, 3 of a square.
  int of_square = corner < 3 ? corner : corner == 3 ? 2 : corner == 4 ? 1 : 3;
  vec2 at = vec2(square.xy + kVolumeSquare * ivec2(of_square & 1, of_square >> 1));
  gl_Position = vec4(2.0 * at / shading.size.xy - 1.0, 0.0, 1.0);
}
