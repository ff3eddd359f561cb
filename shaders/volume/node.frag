// A grid's nodes, lit: what VolumeModel::colours() computes.
#include "include/shared.h"
#include "include/shading.h"
#include "volume/layout.h"

layout(std140, binding = RELIEF_VOLUME_BIND_NODES) uniform NodesBlock { VolumeNodes shading; };
layout(std140, binding = RELIEF_VOLUME_BIND_FRAME) uniform FrameBlock { Frame frame; };
layout(binding = RELIEF_VOLUME_TEXTURE_NODES) uniform sampler3D nodes;
layout(binding = RELIEF_VOLUME_TEXTURE_NORMALS) uniform sampler3D normals;

layout(location = 0) out vec4 out_node;

void main() {
  ivec3 at = ivec3(gl_FragCoord.xy, gl_Layer);
  vec4 node = texelFetch(nodes, at, 0);
  vec3 normal = texelFetch(normals, at, 0).xyz;
  vec3 position = shading.from_eye.xyz + float(at.x) * shading.step_x.xyz +
                  float(at.y) * shading.step_y.xyz + float(at.z) * shading.step_z.xyz;
  vec3 ray = frame.ray_along.w != 0.0 ? frame.ray_along.xyz : normalize(position);
  vec3 colour = shading.size.w * node.rgb;
  float squared = dot(normal, normal);
  if (squared > 0.0)  // else there is nothing to light
    colour = lit(frame, RELIEF_LIGHTS, colour, facing_normal(normal * inversesqrt(squared), ray, false), ray, position);
  out_node = vec4(colour, node.a);
}
