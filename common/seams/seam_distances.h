// How far points are from the seams between patches.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "common/patch.h"
#include "common/seams/seams.h"

namespace relief {

/// The triangles of seams, looked up by position. World frame.
class SeamDistances {
 public:
  SeamDistances(std::span<const Patch> patches, const Seams& seams);

  /// Returns the distance of a point to the nearest triangle; nothing if none is within about two
  /// spacings.
  [[nodiscard]] std::optional<double> find(glm::dvec3 point) const;

 private:
  using Corners = std::array<glm::dvec3, 3>;
  [[nodiscard]] std::uint64_t cube_of(glm::dvec3 position, glm::ivec3 offset) const;

  glm::dvec3 origin_{0.0};
  double side_ = 1.0;
  std::vector<Corners> triangles_;  ///< by cube of their middle
  std::unordered_map<std::uint64_t, std::array<std::uint32_t, 2>> runs_;  ///< first, end
};

}  // namespace relief
