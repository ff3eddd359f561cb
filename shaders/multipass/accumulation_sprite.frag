// Pass 2: casts the view ray at the splat's disc. The depth test sees the disc's nearest point, so
// that it can come first and reject what is hidden; here the disc's own depth is compared.
#include "multipass/accumulation.glsl"
#include "multipass/cast_ray.glsl"

layout(binding = RELIEF_TEXTURE_VISIBLE_DEPTH) uniform sampler2D visible_depth;

void main() {
  count_fragment();
  PlaceInPlane hit = cast_ray();
  vec4 footprint = RELIEF_DISC_FOOTPRINT(hit.place);
  float visible = texelFetch(visible_depth, ivec2(gl_FragCoord.xy), 0).x;
  // In this form an undefined place is discarded too.
  if (!(dot(hit.place, hit.place) <= 1.0 && value_at(hit) > visible)) discard;
  accumulate(hit.place, depth_at(hit), footprint);
}
