// Pass 2: casts the view ray at the splat's disc. The depth test sees the disc's nearest point, so
// that it can come first and reject what is hidden; here the disc's own depth is compared.
#include "multipass/accumulation.glsl"
#include "multipass/cast_ray.glsl"

layout(binding = RELIEF_TEXTURE_VISIBLE_DEPTH) uniform sampler2D visible_depth;

void main() {
  count_fragment();
  PlaceInPlane hit = cast_ray();
  vec4 footprint = RELIEF_DISC_FOOTPRINT(hit.position);
  float visible = texelFetch(visible_depth, ivec2(gl_FragCoord.xy), 0).x;
#if (RELIEF_FEATURES & RELIEF_FEATURE_CLIPPED) != 0u
  float value = set_back(value_at(hit), depths.y);
#else
  float value = value_at(hit);
#endif
  if (is_off(hit.position) || !(value > visible)) discard;
  accumulate(hit.position, depth_at(hit), footprint);
}
