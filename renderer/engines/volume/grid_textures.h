// A regular grid's nodes as textures.
#pragma once

#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/volume/scalar_volume.h"
#include "renderer/engines/volume/drawing.h"
#include "renderer/gl/object.h"

namespace relief::volume {

/// What does not change with the view, and the colours that were set last.
struct GridTextures {
  Texture nodes;      ///< RGBA16: colour and extinction, as shares of what follows
  Texture distances;  ///< block_distances
  std::optional<Texture> normals = {};
  float extinction = 0.0F;  ///< of a texel's 1, per step of a sheet
  float colour = 1.0F;      ///< of a texel's 1
  std::vector<glm::u16vec4> texels = {};
  std::vector<glm::vec3> colours = {};  ///< those of the texels
};

/// One level, read texel by texel.
[[nodiscard]] Texture make_grid_texture(const Gl& gl, const char* label, GLenum format,
                                        glm::uvec3 size);

/// Sets all texels, whose rows are tightly packed.
void upload_grid(const Gl& gl, const Texture& texture, glm::uvec3 size, GLenum format, GLenum type,
                 const void* texels);

/// Textures of the frame's cloud, without colours. Normals are those of kernels, 0 elsewhere.
[[nodiscard]] GridTextures make_grid_textures(const Gl& gl, const VolumeFrame& frame,
                                              const RegularGrid& grid, bool needs_normals);

/// Uploads colours, one for each kernel, unless they are those of the texels.
void set_colours(const Gl& gl, const VolumeFrame& frame, std::span<const glm::vec3> colours,
                 GridTextures& textures);

}  // namespace relief::volume
