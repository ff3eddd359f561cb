#include "renderer/engines/surfel/surfel_tables.h"

#include <bit>
#include <cstdint>
#include <glm/gtc/packing.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <utility>
#include <vector>

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
Table make_colours(const Gl& gl, const SurfelSet& set, const SplatCloud& cloud) {
  std::vector<std::uint64_t> texels;
  texels.reserve(set.points.size());
  for (const std::uint32_t point : set.points)
    texels.push_back(glm::packHalf4x16(cloud.colours[point]));
  return make_table(gl, "surfel colours", GL_RGBA16F, std::span<const std::uint64_t>(texels));
}

}  // namespace

Result<SurfelTables> upload_surfels(const Gl& gl, const SurfelSet& set, const SplatCloud& cloud) {
  const auto most = static_cast<std::size_t>(get_limit(gl, GL_MAX_TEXTURE_BUFFER_SIZE));
  if (set.points.size() * shared::kSurfelAxesRows > most) {
    return make_error("{} surfels are more than this OpenGL can draw; it can draw {}",
                      set.points.size(), most / shared::kSurfelAxesRows);
  }
  SurfelTables tables{.axes = make_axes(gl, set),
                      .bends = make_bends(gl, set),
                      .identities = make_identities(gl, set, cloud),
                      .colours = {},
                      .texcoords = {},
                      .image = {}};
  if (!cloud.colours.empty()) tables.colours = make_colours(gl, set, cloud);
  RELIEF_TRY(check_errors(gl, "the surfels"));
  return tables;
}

}  // namespace relief::surfel
