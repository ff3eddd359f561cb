// A splat behind what is drawn already: blending multiplies it by the transmittance so far.
#include "include/shared.h"
#include "volume/layout.h"

layout(std140, binding = RELIEF_VOLUME_BIND_RULE) uniform RuleBlock { VolumeRule rule; };

flat in vec4 place;
flat in vec3 shape;
flat in vec3 colour;

layout(location = RELIEF_VOLUME_OUT_COLOUR) out vec4 out_colour;

void main() {
  vec2 d = gl_FragCoord.xy - place.xy;
  float q = shape.x * d.x * d.x + 2.0 * shape.y * d.x * d.y + shape.z * d.y * d.y;
  float alpha = place.w * exp(-0.5 * q);
  if ((rule.image.w & RELIEF_VOLUME_EXPONENTIAL) != 0u)
    alpha = alpha < 4e-3 ? alpha - 0.5 * alpha * alpha : 1.0 - exp(-alpha);
  alpha = min(alpha, rule.limits.y);
  if (!(q < place.z) || alpha < rule.limits.x) discard;
  out_colour = vec4(alpha * colour, alpha);
}
