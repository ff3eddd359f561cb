#include "renderer/engines/volume/grid_textures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "renderer/engines/volume/block_distances.h"
#include "renderer/engines/volume/rule.h"

namespace relief::volume {
namespace {

std::size_t texel_of(const KernelCloud& cloud, const NodeBox& box, std::size_t k) {
  const glm::uvec3 in_box = cloud.node(k) - box.low;
  const glm::uvec3 size = box.size();
  return in_box.x + std::size_t{size.x} * (in_box.y + std::size_t{size.y} * in_box.z);
}

std::uint16_t share_of(float value, float of) {
  return static_cast<std::uint16_t>(std::lround(std::clamp(value / of, 0.0F, 1.0F) * 65535.0F));
}

}  // namespace

Texture make_grid_texture(const Gl& gl, const char* label, GLenum format, glm::uvec3 size) {
  Texture texture(gl, label, GLenum{GL_TEXTURE_3D});
  gl.TextureStorage3D(texture.id(), 1, format, static_cast<GLsizei>(size.x),
                      static_cast<GLsizei>(size.y), static_cast<GLsizei>(size.z));
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

void upload_grid(const Gl& gl, const Texture& texture, glm::uvec3 size, GLenum format, GLenum type,
                 const void* texels) {
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
  gl.TextureSubImage3D(texture.id(), 0, 0, 0, 0, static_cast<GLsizei>(size.x),
                       static_cast<GLsizei>(size.y), static_cast<GLsizei>(size.z), format, type,
                       texels);
  gl.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

GridTextures make_grid_textures(const Gl& gl, const VolumeFrame& frame, const RegularGrid& grid,
                                bool needs_normals) {
  const KernelCloud& cloud = frame.cloud;
  const glm::uvec3 size = frame.box.size();
  const glm::uvec3 blocks = (size - 1U) / std::uint32_t{shared::kVolumeBlock} + 1U;
  GridTextures textures{.nodes = make_grid_texture(gl, "nodes", GL_RGBA16, size),
                        .distances = make_grid_texture(gl, "distances", GL_R8UI, blocks)};
  const double space = std::abs(glm::determinant(grid.step));
  const float most = *std::max_element(cloud.weights.begin(), cloud.weights.end());
  textures.extinction = static_cast<float>(
      std::min(static_cast<double>(most) / space, static_cast<double>(kLargest)));
  textures.texels.assign(std::size_t{size.x} * size.y * size.z, glm::u16vec4(0));
  std::vector<glm::i8vec4> normals(needs_normals ? textures.texels.size() : 0);
  for (std::size_t k = 0; k < cloud.count(); ++k) {
    const std::size_t texel = texel_of(cloud, frame.box, k);
    textures.texels[texel].w = share_of(cloud.weights[k], most);
    if (needs_normals)
      normals[texel] = glm::i8vec4(glm::round(127.0F * glm::vec4(cloud.normals[k], 0.0F)));
  }
  upload_grid(gl, textures.distances, blocks, GL_RED_INTEGER, GL_UNSIGNED_BYTE,
              block_distances(textures.texels, size).data());
  if (!needs_normals) return textures;
  textures.normals = make_grid_texture(gl, "node normals", GL_RGBA8_SNORM, size);
  upload_grid(gl, *textures.normals, size, GL_RGBA, GL_BYTE, normals.data());
  return textures;
}

void set_colours(const Gl& gl, const VolumeFrame& frame, std::span<const glm::vec3> colours,
                 GridTextures& textures) {
  if (std::equal(colours.begin(), colours.end(), textures.colours.begin(), textures.colours.end()))
    return;
  textures.colours.assign(colours.begin(), colours.end());
  float most = 0.0F;
  for (const glm::vec3& colour : colours) most = std::max({most, colour.x, colour.y, colour.z});
  most = std::clamp(most, 1e-30F, kLargest);
  textures.colour = most;
  tbb::parallel_for(std::size_t{0}, colours.size(), [&](std::size_t k) {
    glm::u16vec4& texel = textures.texels[texel_of(frame.cloud, frame.box, k)];
    texel.x = share_of(colours[k].x, most);
    texel.y = share_of(colours[k].y, most);
    texel.z = share_of(colours[k].z, most);
  });
  upload_grid(gl, textures.nodes, frame.box.size(), GL_RGBA, GL_UNSIGNED_SHORT,
              textures.texels.data());
}

}  // namespace relief::volume
