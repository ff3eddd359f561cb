#include "viewer/measuring/surface_attributes.h"

#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/octahedral.h"
#include "renderer/geometry/patch_normals.h"
#include "viewer/measuring/drawn_surface.h"

namespace relief {
namespace {

/// Cells around a position whose heights decide the normals of its own: slopes look one node
/// further, and over holes the next samples are continued.
constexpr double kCellsAround = 4.0;

glm::dvec2 stereographic(glm::i16vec2 texel) {
  const glm::dvec3 n(unit_from_snorm16(texel));
  return glm::dvec2(n) / (1.0 + n.z);
}

glm::dvec3 unit_from_stereographic(glm::dvec2 p) {
  const double squared = glm::dot(p, p);
  return glm::dvec3(2.0 * p, 1.0 - squared) / (1.0 + squared);
}

/// A bilinear lookup.
glm::dvec3 look_up_normal(const AttributeMap<glm::i16vec2>& map, glm::dvec2 uv) {
  const glm::uvec2 most(map.width - 1, map.height - 1);
  const glm::dvec2 texel =
      glm::clamp(uv * static_cast<double>(map.scale), glm::dvec2(0.0), glm::dvec2(most));
  const glm::uvec2 low(texel);
  const glm::uvec2 high = glm::min(low + 1U, most);
  const glm::dvec2 part = texel - glm::dvec2(low);
  const auto at = [&map](std::uint32_t i, std::uint32_t j) {
    return stereographic(map.texels[std::size_t{j} * map.width + i]);
  };
  return unit_from_stereographic(glm::mix(glm::mix(at(low.x, low.y), at(high.x, low.y), part.x),
                                          glm::mix(at(low.x, high.y), at(high.x, high.y), part.x),
                                          part.y));
}

}  // namespace

glm::dvec3 normal_at(const Patch& patch, glm::dvec2 uv) {
  if (!patch.normals.empty()) return look_up_normal(patch.normals, uv);
  const auto range = nodes_about(patch, glm::dvec3(uv, 0.0), kCellsAround);
  if (!range) return {0.0, 0.0, 1.0};
  return look_up_normal(normal_map_of(window_of(patch, *range)), uv - glm::dvec2(range->first));
}

std::optional<glm::u8vec3> stored_colour_at(const Patch& patch, glm::dvec2 uv) {
  const AttributeMap<glm::u8vec3>& map = patch.colours;
  if (map.empty()) return std::nullopt;
  const glm::dvec2 most(map.width - 1, map.height - 1);
  const glm::uvec2 texel(
      glm::clamp(glm::round(uv * static_cast<double>(map.scale)), glm::dvec2(0.0), most));
  return map.texels[std::size_t{texel.y} * map.width + texel.x];
}

}  // namespace relief
