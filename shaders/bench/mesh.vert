// The bench's mesh: a triangle list with vertex normals. Its one "patch" is the mesh's frame.
#include "include/patches.glsl"

layout(location = RELIEF_ATTRIBUTE_POSITION) in vec3 position;
layout(location = RELIEF_ATTRIBUTE_NORMAL) in vec3 normal;
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
layout(location = RELIEF_ATTRIBUTE_COLOUR) in vec3 colour;
layout(location = 2) out vec3 seen_colour;
#endif
layout(location = 0) out vec3 seen_normal;
layout(location = 1) out vec3 ray;

void main() {
  seen_normal = normal;
  ray = ray_toward(position, fetch_eye(0u));
#if (RELIEF_FEATURES & RELIEF_FEATURE_COLOURS) != 0u
  seen_colour = colour;
#endif
  gl_Position = fetch_clip_from_grid(0u) * vec4(position, 1.0);
}
