// World directions of the texels of a cube map.

layout(location = 0) uniform int face;       // as OpenGL numbers them: +X -X +Y -Y +Z -Z
layout(location = 1) uniform int face_size;  // texels

// The direction (any length) at a window position on the face (OpenGL 4.5, table 8.19).
vec3 face_direction(vec2 window) {
  vec2 st = 2.0 * window / float(face_size) - 1.0;
  if (face == 0) return vec3(1.0, -st.y, -st.x);
  if (face == 1) return vec3(-1.0, -st.y, st.x);
  if (face == 2) return vec3(st.x, 1.0, st.y);
  if (face == 3) return vec3(st.x, -1.0, -st.y);
  if (face == 4) return vec3(st.x, -st.y, 1.0);
  return vec3(-st.x, -st.y, -1.0);
}
