// Octahedral coding: unit vectors as two 16-bit numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// Returns the octahedral coordinates, in [-1, 1]^2, of a unit vector (Meyer et al. 2010). The
/// upper half space is the diamond |x| + |y| <= 1, on which interpolation has no fold: patch
/// normals lie there.
[[nodiscard]] inline glm::vec2 octahedral_from_unit(glm::vec3 n) {
  const glm::vec2 p = glm::vec2(n) / (std::abs(n.x) + std::abs(n.y) + std::abs(n.z));
  if (n.z >= 0.0F) return p;
  const glm::vec2 sign(p.x >= 0.0F ? 1.0F : -1.0F, p.y >= 0.0F ? 1.0F : -1.0F);
  return (1.0F - glm::abs(glm::vec2(p.y, p.x))) * sign;
}

/// Returns the unit vector of octahedral coordinates.
[[nodiscard]] inline glm::vec3 unit_from_octahedral(glm::vec2 p) {
  glm::vec3 n(p, 1.0F - std::abs(p.x) - std::abs(p.y));
  const float fold = std::max(-n.z, 0.0F);
  n.x += n.x >= 0.0F ? -fold : fold;
  n.y += n.y >= 0.0F ? -fold : fold;
  return glm::normalize(n);
}

/// Returns octahedral coordinates as signed normalised 16-bit numbers (OpenGL's RG16_SNORM).
[[nodiscard]] inline glm::i16vec2 snorm16_from_unit(glm::vec3 n) {
  const glm::vec2 p = octahedral_from_unit(n) * 32767.0F;
  return {static_cast<std::int16_t>(std::lround(p.x)), static_cast<std::int16_t>(std::lround(p.y))};
}

/// Inverse of snorm16_from_unit.
[[nodiscard]] inline glm::vec3 unit_from_snorm16(glm::i16vec2 p) {
  return unit_from_octahedral(glm::max(glm::vec2(p) / 32767.0F, glm::vec2(-1.0F)));
}

}  // namespace relief
