// The nodes of a sheet, shaded: colour times extinction, and extinction.
#include "volume/sheets.glsl"
#if (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
#include "include/shading.h"

layout(std140, binding = RELIEF_VOLUME_BIND_FRAME) uniform FrameBlock { Frame frame; };
layout(binding = RELIEF_VOLUME_TEXTURE_NORMALS) uniform sampler3D normals;
#endif
layout(binding = RELIEF_VOLUME_TEXTURE_NODES) uniform sampler3D nodes;

flat in ivec3 origin;

layout(location = 0) out vec4 out_node;

void main() {
  ivec2 uv = ivec2(gl_FragCoord.xy) - origin.xy;
  // Squares may reach beyond the sheet.
  bool is_inside = all(lessThan(uv, ivec2(grid.u.w, grid.v.w)));
  uv = min(uv, ivec2(grid.u.w, grid.v.w) - 1);
  ivec3 texel = uv.x * grid.u.xyz + uv.y * grid.v.xyz + origin.z * grid.w.xyz;
  vec4 node = texelFetch(nodes, texel, 0);
  vec3 colour = node.rgb;
#if (RELIEF_FEATURES & RELIEF_FEATURE_LIT) != 0u
  vec3 normal = texelFetch(normals, texel, 0).xyz;
  float squared = dot(normal, normal);
  vec3 position = sheets.from_eye.xyz + float(uv.x) * sheets.step_u.xyz +
                  float(uv.y) * sheets.step_v.xyz + float(origin.z) * sheets.step_w.xyz;
  vec3 ray = sheets.eye.w != 0.0 ? frame.ray_along.xyz : position * inversesqrt(dot(position, position));
  vec3 facing = facing_normal(normal * inversesqrt(max(squared, 1e-12)), ray);
  if (squared > 0.0) colour = lit(frame, RELIEF_LIGHTS, colour, facing, ray, position);
#endif
  out_node = is_inside ? vec4(node.a * colour, node.a) : vec4(0.0);
}
