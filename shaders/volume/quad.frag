// A splat behind what is drawn already: blending multiplies it by the transmittance so far.
#include "include/shared.h"
#include "volume/layout.h"
#include "volume/limits.glsl"

flat in vec4 place;
flat in vec3 shape;
flat in vec3 colour;
flat in vec4 depths;  // mean at the centre, its slope, deviation

layout(location = RELIEF_VOLUME_OUT_COLOUR) out vec4 out_colour;

void main() {
  vec2 d = gl_FragCoord.xy - place.xy;
  float q = shape.x * d.x * d.x + 2.0 * shape.y * d.x * d.y + shape.z * d.y * d.y;
  float weight = place.w * exp(-0.5 * q);
  if ((rule.image.w & RELIEF_VOLUME_PEAK) != 0u) weight = min(weight, rule.limits.y);
  if (!(q < place.z) || weight < rule.limits.x) discard;
  float limit = limit_of_pixel();
  if (limit < kInfinity)
    weight = weight_before(weight, depths.x + dot(depths.yz, d), depths.w, limit);
  float alpha = opacity_of(weight);
  out_colour = vec4(alpha * colour, alpha);
}
