// One face of the cube map from an equirectangular picture: +Y is up, the middle of the picture is
// -Z, its right half is toward +X.
#include "include/cube_face.glsl"

layout(binding = 0) uniform sampler2D picture;
layout(location = 2) uniform float lod;  // level of the picture with about a texel per texel

layout(location = 0) out vec4 colour;

void main() {
  const float pi = 3.14159265358979;
  vec3 d = normalize(face_direction(gl_FragCoord.xy));
  vec2 place = vec2(0.5 + atan(d.x, -d.z) / (2.0 * pi), acos(clamp(d.y, -1.0, 1.0)) / pi);
  colour = textureLod(picture, place, lod);
}
