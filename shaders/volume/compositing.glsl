// Layers, composited front to back [Zwicker 2002, Eq. (7) and (10)]; as in
// renderer/engines/volume_reference/composite.cpp.
#include "include/shared.h"
#include "volume/layout.h"
#include "volume/limits.glsl"

layout(location = RELIEF_VOLUME_OUT_COLOUR) out vec4 out_colour;
#if RELIEF_FEATURES & (RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH)
layout(location = RELIEF_VOLUME_OUT_SURFACE) out vec4 out_surface;
#endif

/// What the splats of a group leave in a pixel, before it is composited.
struct Layer {
  float depth_sum;  ///< optical depth, or opacity
  vec3 colour;      ///< times that
  vec3 normal;
  float place;      ///< depth along the axis, times that
};

/// What a pixel shows.
struct Pixel {
  vec3 colour;  ///< times its opacity
  float transmittance;
  vec3 normal;
  float depth;  ///< where half of what is behind is covered
};

Layer empty_layer() { return Layer(0.0, vec3(0.0), vec3(0.0), 0.0); }
Pixel empty_pixel() { return Pixel(vec3(0.0), 1.0, vec3(0.0), kInfinity); }

void add(inout Layer layer, float weight, vec3 colour, vec3 normal, float place) {
  layer.depth_sum += weight;
  layer.colour += weight * colour;
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL
  layer.normal += weight * normal;
#endif
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH
  layer.place += weight * place;
#endif
}

/// Puts a layer behind what the pixel shows, and empties it. Returns whether the pixel has ended.
bool end_layer(inout Pixel shown, inout Layer layer) {
  float sum = layer.depth_sum;
  if (!(sum > 0.0)) return false;
  float alpha = opacity_of(sum);
  float after = shown.transmittance * (1.0 - alpha);
  bool ends = after < rule.limits.z;
  // As [Kerbl 2023] does: what would end a pixel is left out.
  if (ends && (rule.image.w & RELIEF_VOLUME_PEAK) != 0u) return true;
  float share = shown.transmittance * alpha / sum;
  shown.colour += share * layer.colour;
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_NORMAL
  shown.normal += share * layer.normal;
#endif
#if RELIEF_FEATURES & RELIEF_FEATURE_OUT_DEPTH
  if (shown.transmittance > 0.5 && after <= 0.5) shown.depth = layer.place / sum;
#endif
  shown.transmittance = after;
  layer = empty_layer();
  return ends;
}

void write_pixel(Pixel shown) {
  out_colour = vec4(shown.colour, shown.transmittance);
#if RELIEF_FEATURES & (RELIEF_FEATURE_OUT_NORMAL | RELIEF_FEATURE_OUT_DEPTH)
  out_surface = vec4(shown.normal, shown.depth);
#endif
}
