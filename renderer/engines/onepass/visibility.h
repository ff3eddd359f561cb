// What cells find before it is shaded: a visibility buffer.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>

#include "common/error.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/patch_store.h"

namespace relief::onepass {

/// One for each image, of its size. It is never cleared: where the depth buffer is, nothing reads
/// it.
struct Visibility {
  Texture coordinates;            ///< RG32UI: as shaders/include/visibility.glsl packs them
  std::optional<Texture> depths;  ///< R32F: along the view axis, where features need it
  Framebuffer framebuffer;        ///< they and the image's depth buffer
};

/// What OpenGL calls the parts of one.
struct VisibilityLabels {
  const char* coordinates = "coordinates";
  const char* depths = "depths";
  const char* framebuffer = "visibility";
};

/// Makes it, of the size of an image; `z_buffer` must outlive it. Fails if OpenGL lacks memory.
Result<Visibility> make_visibility(const Gl& gl, glm::uvec2 size, const Texture& z_buffer,
                                   Features features, const VisibilityLabels& labels = {});

/// Whether every patch of the store has a number that a position can name.
[[nodiscard]] bool can_be_found(const PatchStore& store);

/// Steps a cell that positions are noted in: a power of two, as many as patches of `side` nodes
/// leave bits for. 8192 for up to 503, 128 for the widest that there can be.
[[nodiscard]] float position_steps(std::uint32_t side);

}  // namespace relief::onepass
