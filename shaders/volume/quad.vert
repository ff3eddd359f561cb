// A splat as a quad around its ellipse, two triangles.
#include "include/shared.h"
#include "volume/layout.h"

layout(std140, binding = RELIEF_VOLUME_BIND_RULE) uniform RuleBlock { VolumeRule rule; };
layout(binding = RELIEF_VOLUME_TEXTURE_SPLATS) uniform samplerBuffer splats;

flat out vec4 place;
flat out vec3 shape;
flat out vec3 colour;
flat out vec4 depths;  // mean at the centre, its slope, deviation; unless nothing is limited

/// Half the side, in pixels, from which on a quad is cut to the image: vertices stay where floats
/// tell pixels apart.
const float kLargestHalf = 4096.0;

void main() {
  int at = gl_VertexID / 6 * kVolumeSplatRows;
  int corner = gl_VertexID % 6;
  place = texelFetch(splats, at);
  vec4 shape_and_depth = texelFetch(splats, at + 1);
  shape = shape_and_depth.xyz;
  vec4 colour_and_deviation = texelFetch(splats, at + 2);
  colour = colour_and_deviation.rgb;
  depths = vec4(0.0);
  if ((rule.image.w & RELIEF_VOLUME_LIMITED) != 0u) {
    depths = vec4(shape_and_depth.w, texelFetch(splats, at + 4).xy, colour_and_deviation.w);
  }
  // Corners 0, 1, 2 and 2, 1, 3 of a square.
  int of_square = corner < 3 ? corner : corner == 3 ? 2 : corner == 4 ? 1 : 3;
  vec2 side = vec2((of_square & 1) == 0 ? -1.0 : 1.0, of_square < 2 ? -1.0 : 1.0);
  // The ellipse's axes: the eigenvectors of Q, long where its eigenvalues are small.
  float half_sum = 0.5 * (shape.x + shape.z);
  float root = length(vec2(0.5 * (shape.x - shape.z), shape.y));
  float larger = half_sum + root;
  float smaller = max((shape.x * shape.z - shape.y * shape.y) / larger, 1e-30);
  vec2 across = shape.x > shape.z ? vec2(larger - shape.z, shape.y) : vec2(shape.y, larger - shape.x);
  float size = length(across);
  across = size > 0.0 ? across / size : vec2(1.0, 0.0);
  // A little more than the ellipse, against rounding.
  float wide = sqrt(place.z / larger) + 0.02;
  float high = 1.001 * sqrt(place.z / smaller) + 0.02;
  vec2 image = vec2(rule.image.xy);
  vec2 corner_at = place.xy + side.x * wide * across + side.y * high * vec2(-across.y, across.x);
  if (max(wide, high) > kLargestHalf) {
    float determinant = shape.x * shape.z - shape.y * shape.y;
    vec2 reach = sqrt(place.z * vec2(shape.z, shape.x) / max(determinant, 1e-30)) * 1.001;
    corner_at = clamp(place.xy + side * reach, vec2(-1.0), image + 1.0);
  }
  gl_Position = vec4(2.0 * corner_at / image - 1.0, 0.0, 1.0);
}
