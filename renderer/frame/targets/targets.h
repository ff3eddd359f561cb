// The framebuffer of an image, and how it becomes an Image.
#pragma once

#include <cstdint>
#include <optional>

#include "common/error.h"
#include "common/image/image.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/settings.h"

namespace relief {

/// Attachments for the outputs that are on; nothing is allocated for the others. Colour is half
/// float: eleven bits of precision at any brightness, so that every 8-bit sRGB value survives the
/// way through linear light, at half the bytes of float.
struct Targets {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  Framebuffer framebuffer;
  Texture colour;
  Texture z_buffer;
  std::optional<Texture> normal;
  std::optional<Texture> depth;
  std::optional<Texture> uv;
  std::optional<Texture> patch_id;
  std::optional<Texture> clip;
};

/// The most pixels along a side of an image.
[[nodiscard]] std::uint32_t largest_target(const Gl& gl);

/// Fails if the image is larger than OpenGL allows or its memory.
Result<Targets> make_targets(const Gl& gl, std::uint32_t width, std::uint32_t height,
                             const Outputs& outputs);

/// Clears for a frame: colour to `background` with coverage 0, depth to infinity, all else to 0.
void clear_targets(const Gl& gl, const Targets& targets, const glm::vec3& background);

/// Reads all outputs back, top row first, channels as common/image.h names them. A is the model's
/// coverage.
[[nodiscard]] Image read_targets(const Gl& gl, const Targets& targets);

/// Reads the channels R, G, B and A alone of a colour attachment.
[[nodiscard]] Image read_colour(const Gl& gl, const Texture& colour, std::uint32_t width,
                                std::uint32_t height);

}  // namespace relief
