// What a volume is drawn into, and how it becomes a film.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/error.h"
#include "renderer/frame/targets/film.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/gl/shader/features.h"

namespace relief::volume {

/// Colour and transmittance, and normal and depth if they are asked for: floats, because half
/// floats lose small opacities.
struct VolumeTargets {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Texture colour;
  std::optional<Texture> surface;
  Framebuffer framebuffer;
};

/// Fails if OpenGL does not allow an image of that size.
Result<VolumeTargets> make_volume_targets(const Gl& gl, std::uint32_t width, std::uint32_t height,
                                          Features features);

/// Nothing drawn: colour 0, transmittance 1, normal 0, infinite depth.
void clear_volume_targets(const Gl& gl, const VolumeTargets& targets);

/// A texture of depths (row-major, top row first), as RELIEF_VOLUME_TEXTURE_LIMITS.
[[nodiscard]] Texture make_limits(const Gl& gl, std::uint32_t width, std::uint32_t height,
                                  std::span<const float> depths);

/// What was drawn. `is_encoded`: colours were blended as encoded sRGB.
[[nodiscard]] Film read_film(const Gl& gl, const VolumeTargets& targets, bool is_encoded);

}  // namespace relief::volume
