#include "renderer/engines/surfel/surfel_tables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

#include "common/image/srgb.h"
#include "shaders/surfel/layout.h"

namespace relief::surfel {
namespace {

Table make_axes(const Gl& gl, const SurfelSet& set) {
  std::vector<glm::vec4> texels;
  texels.reserve(set.axes.size() * shared::kSurfelAxesRows);
  for (std::size_t k = 0; k < set.axes.size(); ++k) {
    texels.emplace_back(set.axes[k].u, set.radii[k]);
    texels.emplace_back(set.axes[k].v, 0.0F);
  }
  return make_table(gl, "surfel axes", GL_RGBA32F, std::span<const glm::vec4>(texels));
}

Table make_bends(const Gl& gl, const SurfelSet& set) {
  std::vector<glm::vec4> texels;
  texels.reserve(set.bends.size());
  for (const glm::vec3 bend : set.bends) texels.emplace_back(bend, 0.0F);
  return make_table(gl, "surfel bends", GL_RGBA32F, std::span<const glm::vec4>(texels));
}

Table make_identities(const Gl& gl, const SurfelSet& set, const SplatCloud& cloud) {
  std::vector<glm::uvec4> texels;
  texels.reserve(set.points.size());
  for (const std::uint32_t point : set.points) {
    const glm::vec2 uv = cloud.uvs.empty() ? glm::vec2(0.0F) : cloud.uvs[point];
    texels.emplace_back(std::bit_cast<std::uint32_t>(uv.x), std::bit_cast<std::uint32_t>(uv.y),
                        cloud.patches.empty() ? 0U : cloud.patches[point],
                        cloud.materials.empty() ? 0U : std::uint32_t{cloud.materials[point]});
  }
  return make_table(gl, "surfel identities", GL_RGBA32UI, std::span<const glm::uvec4>(texels));
}

/// Half floats, which keep what 8 bits of sRGB tell apart.
Table make_colours(const Gl& gl, const SurfelSet& set) {
  std::vector<std::uint64_t> texels;
  texels.reserve(set.colours.size());
  for (const glm::vec4& colour : set.colours) texels.push_back(glm::packHalf4x16(colour));
  return make_table(gl, "surfel colours", GL_RGBA16F, std::span<const std::uint64_t>(texels));
}

Table make_texcoords(const Gl& gl, const SurfelSet& set, const SplatCloud& cloud) {
  std::vector<glm::vec4> texels;
  texels.reserve(set.points.size() * shared::kSurfelTexcoordRows);
  for (std::size_t k = 0; k < set.points.size(); ++k) {
    const glm::vec2 texcoord = cloud.texcoords[set.points[k]];
    if (std::isfinite(texcoord.x) && std::isfinite(texcoord.y)) {
      texels.emplace_back(texcoord, set.gradients[k][0]);
      texels.emplace_back(set.gradients[k][1], 0.0F, 0.0F);
      texels.emplace_back(0.0F);
    } else {
      const glm::vec3 colour =
          set.colours.empty() ? glm::vec3(shared::kNeutralGrey) : glm::vec3(set.colours[k]);
      texels.insert(texels.end(), 2, glm::vec4(0.0F));
      texels.emplace_back(colour, 1.0F);
    }
  }
  return make_table(gl, "surfel texture coordinates", GL_RGBA32F,
                    std::span<const glm::vec4>(texels));
}

/// The image with mip levels, top row first as texture coordinates count; sRGB in 8 bits, which
/// image files have. Brighter values are clamped.
Result<Texture> make_image(const Gl& gl, const Image& image) {
  const auto most = static_cast<std::uint32_t>(get_limit(gl, GL_MAX_TEXTURE_SIZE));
  if (image.width > most || image.height > most) {
    return make_error("a texture of {}x{} texels can't be drawn: this OpenGL allows {} a side",
                      image.width, image.height, most);
  }
  std::vector<glm::u8vec4> texels(std::size_t{image.width} * image.height, glm::u8vec4(255));
  glm::length_t c = 0;
  for (const char* const name : {"R", "G", "B"}) {
    const Channel* const channel = image.find(name);
    for (std::size_t k = 0; channel != nullptr && k < texels.size(); ++k)
      texels[k][c] = srgb8_from_linear(channel->values[k]);
    ++c;
  }
  Texture texture(gl, "surfel image", GLenum{GL_TEXTURE_2D});
  const auto width = static_cast<GLsizei>(image.width);
  const auto height = static_cast<GLsizei>(image.height);
  const auto levels = static_cast<GLsizei>(std::bit_width(std::max(image.width, image.height)));
  gl.TextureStorage2D(texture.id(), levels, GL_SRGB8_ALPHA8, width, height);
  gl.TextureSubImage2D(texture.id(), 0, 0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE,
                       texels.data());
  gl.GenerateTextureMipmap(texture.id());
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  gl.TextureParameteri(texture.id(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  RELIEF_TRY(check_errors(gl, "the texture"));
  return texture;
}

}  // namespace

Result<SurfelTables> upload_surfels(const Gl& gl, const SurfelSet& set, const SplatCloud& cloud) {
  const auto most = static_cast<std::size_t>(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE));
  const auto rows = static_cast<std::size_t>(set.gradients.empty() ? shared::kSurfelAxesRows
                                                                   : shared::kSurfelTexcoordRows);
  if (set.points.size() * rows > most) {
    return make_error("{} surfels are more than this OpenGL can draw; it can draw {}",
                      set.points.size(), most / rows);
  }
  SurfelTables tables{.axes = make_axes(gl, set),
                      .bends = make_bends(gl, set),
                      .identities = make_identities(gl, set, cloud),
                      .colours = {},
                      .texcoords = {},
                      .image = {}};
  if (!set.colours.empty()) tables.colours = make_colours(gl, set);
  if (!set.gradients.empty()) {
    tables.texcoords = make_texcoords(gl, set, cloud);
    RELIEF_TRY_ASSIGN(tables.image, make_image(gl, *cloud.texture));
  }
  RELIEF_TRY(check_errors(gl, "the surfels"));
  return tables;
}

}  // namespace relief::surfel
