// One face of the built-in environment: a sky over a ground, each side in a tint of its own, with
// dark grid lines (as Figure 6 of paper 001) in which a wrong normal shows.
#include "include/cube_face.glsl"

layout(location = 0) out vec4 colour;

void main() {
  const vec3 tints[6] = vec3[6](vec3(1.0, 0.55, 0.45), vec3(0.5, 0.85, 1.0), vec3(1.0),
                                vec3(0.9, 0.75, 0.55), vec3(0.6, 1.0, 0.6), vec3(1.0, 0.9, 0.45));
  const float lines = 8.0;      // per face
  const float thickness = 0.06;  // of a field
  vec3 d = normalize(face_direction(gl_FragCoord.xy));
  float sky = smoothstep(-0.1, 0.1, d.y);
  vec3 light = mix(vec3(0.25, 0.22, 0.2), mix(vec3(0.85), vec3(0.5, 0.65, 0.9), max(d.y, 0.0)), sky);
  vec2 field = gl_FragCoord.xy / float(face_size) * lines;
  vec2 to_line = abs(field - round(field));
  float width = lines / float(face_size);  // a texel, in fields
  vec2 clear = smoothstep(0.5 * thickness - width, 0.5 * thickness + width, to_line);
  colour = vec4(light * tints[face] * mix(0.04, 1.0, clear.x * clear.y), 1.0);
}
