// As present.frag, with eye-dome lighting.
#include "include/shared.h"
#include "include/srgb.glsl"

layout(binding = RELIEF_TEXTURE_PIXEL_SAMPLES) uniform sampler2D picture;
layout(binding = RELIEF_TEXTURE_VISIBLE_DEPTH) uniform sampler2D picture_depth;

layout(location = RELIEF_UNIFORM_EXPOSURE) uniform float exposure;
// Strength of the shade where a surface lies behind its neighbours.
layout(location = RELIEF_UNIFORM_SHADE) uniform float shade;

// Of an orthographic camera: from its depth values to what steps are measured in; 0: perspective.
layout(location = RELIEF_UNIFORM_DEPTH_SCALE) uniform float depth_scale;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

// Eye-dome lighting as renderer/eye_dome.cpp has it: the mean of how much nearer the neighbours are.
float eye_dome(ivec2 at) {
  float own = texelFetch(picture_depth, at, 0).r;
  if (own == 0.0) return 1.0;
  ivec2 size = textureSize(picture_depth, 0);
  float radius = kEyeDomeRadius * float(size.y);
  int straight = max(1, int(radius + 0.5));
  int diagonal = max(1, int(0.7071 * radius + 0.5));
  float nearer = 0.0;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      ivec2 beside = at + (dx * dy == 0 ? straight : diagonal) * ivec2(dx, dy);
      if (any(lessThan(beside, ivec2(0))) || any(greaterThanEqual(beside, size))) continue;
      float other = texelFetch(picture_depth, beside, 0).r;
      // Depth is reversed: near over distance, or linear from 1 to 0.
      if (other > own) nearer += depth_scale > 0.0 ? depth_scale * (other - own) : log2(other / own);
    }
  }
  return exp(-kEyeDomeFactor * shade * nearer / 8.0);
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 light = texelFetch(picture, at, 0).rgb * eye_dome(at);
  out_colour = vec4(srgb_of(exposure * light), 1.0);
}
