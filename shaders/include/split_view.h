// The split view of Figure 1(d) of [Ochotta 2008], for all engines: GLSL and C++ compile the same
// text. C++ includes it as "shaders/include/split_view.h"; shaders as "include/split_view.h".
#pragma once

#ifdef __cplusplus
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "shaders/include/shading.h"
#define RELIEF_ALWAYS_PERSPECTIVE 0
namespace relief::shared {
using glm::abs;
using glm::cross;
using glm::floor;
using glm::vec2;
#else
#include "include/shading.h"
#define RELIEF_ALWAYS_PERSPECTIVE (RELIEF_FEATURES & RELIEF_FEATURE_ORTHOGRAPHIC) == 0u
#endif

/// A colour for three numbers, unlike those of numbers near them (PCG3D: Jarzynski and Olano, "Hash
/// Functions for GPU Rendering", 2020). Linear, each channel 0 to 1.
RELIEF_FUNCTION vec3 unique_colour(uint x, uint y, uint z) {
  x = x * 1664525u + 1013904223u;
  y = y * 1664525u + 1013904223u;
  z = z * 1664525u + 1013904223u;
  x += y * z;
  y += z * x;
  z += x * y;
  x ^= x >> 16u;
  y ^= y >> 16u;
  z ^= z >> 16u;
  x += y * z;
  y += z * x;
  z += x * y;
  return vec3(float(x >> 24u), float(y >> 24u), float(z >> 24u)) / 255.0f;
}

/// A patch as it is stored: each of its samples a disc of reduced radius in a colour of its own
/// ([Ochotta 2008], Figure 1(d)), half way to the patch's colour, which is between them, a quarter
/// as bright. `position`: in cells of the level that is drawn, from the patch's first sample.
/// `patch_id`: counted from 0.
RELIEF_FUNCTION vec3 stored_samples(vec2 position, uint patch_id) {
  vec3 patch_colour = unique_colour(0xFFFFFFFFu, 0xFFFFFFFFu, patch_id);
  vec2 nearest = floor(position + 0.5f);
  vec2 off = position - nearest;
  if (dot(off, off) > kShownSample * kShownSample) return 0.25f * patch_colour;
  return 0.5f *
         (patch_colour + unique_colour(uint(int(nearest.x)), uint(int(nearest.y)), patch_id));
}

/// The split view of what is seen along `ray`, or orthographic at the position `ray` from the eye:
/// the image's quarters are lit (upper left), a mirror (upper right), the mean of both (lower
/// right), and the samples (lower left), with white lines between them. The image's middle is where
/// the view axis meets it, so that parts of an image agree.
RELIEF_FUNCTION vec3 split_view(RELIEF_IN(Frame) frame, vec3 ray, vec3 lit_light, vec3 mirror_light,
                                vec3 samples) {
  vec3 right = vec3(frame.ray_x);
  vec3 up = vec3(frame.ray_y);
#if RELIEF_ALWAYS_PERSPECTIVE
  float depth = max(-dot(ray, normalize(cross(right, up))), 1e-20f);
#else
  float depth =
      frame.ray_along.w > 0.0f ? 1.0f : max(-dot(ray, normalize(cross(right, up))), 1e-20f);
#endif
  float x = dot(ray, right) / (dot(right, right) * depth);  // pixels from the middle
  float y = dot(ray, up) / (dot(up, up) * depth);
  if (min(abs(x), abs(y)) < kSplitLine) return vec3(1.0f);
  if (y > 0.0f) return x < 0.0f ? lit_light : mirror_light;
  return x < 0.0f ? samples : 0.5f * (lit_light + mirror_light);
}

#ifdef __cplusplus
}  // namespace relief::shared
#endif
