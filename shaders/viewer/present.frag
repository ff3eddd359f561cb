// From a picture in linear light to the window, which takes sRGB.
#include "include/shared.h"

layout(binding = RELIEF_TEXTURE_PIXEL_SAMPLES) uniform sampler2D picture;
layout(binding = RELIEF_TEXTURE_VISIBLE_DEPTH) uniform sampler2D picture_depth;

layout(location = RELIEF_UNIFORM_EXPOSURE) uniform float exposure;
// Strength of the shade where points lie behind their neighbours, 0: none.
layout(location = RELIEF_UNIFORM_SHADE) uniform float shade;

// Width and height in pixels.
layout(location = RELIEF_UNIFORM_WINDOW) uniform ivec3 window;

layout(location = RELIEF_OUT_COLOUR) out vec4 out_colour;

vec3 srgb_of(vec3 linear) {
  vec3 light = clamp(linear, 0.0, 1.0);
  return mix(12.92 * light, 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055,
             greaterThan(light, vec3(0.0031308)));
}

// Eye-dome lighting [Boucheny 2009]: the mean of how much nearer the neighbours are, in octaves.
float eye_dome(ivec2 at) {
  float own = texelFetch(picture_depth, at, 0).r;
  if (own == 0.0) return 1.0;
  ivec2 last = textureSize(picture_depth, 0) - 1;
  float nearer = 0.0;
  for (int k = 0; k < 4; ++k) {
    ivec2 aside = (k & 1) == 0 ? ivec2(2, 0) : ivec2(0, 2);
    float other = texelFetch(picture_depth, clamp(at + (k < 2 ? aside : -aside), ivec2(0), last), 0).r;
    // Depth is reversed and infinite: near over distance.
    if (other > 0.0) nearer += max(0.0, log2(other / own));
  }
  return exp(-shade * nearer * 0.25);
}

void main() {
  vec2 share = gl_FragCoord.xy / vec2(window.xy);
  vec3 light = texture(picture, share).rgb;
  if (shade > 0.0) light *= eye_dome(ivec2(share * vec2(textureSize(picture_depth, 0))));
  out_colour = vec4(srgb_of(exposure * light), 1.0);
}
