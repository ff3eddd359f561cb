// Looks border vertices up by position.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/seams/border_mesh.h"
#include "common/seams/cube_runs.h"

namespace relief {

/// Border vertices in cubes of about three spacings.
class VertexGrid {
 public:
  explicit VertexGrid(const std::vector<BorderVertex>& vertices);

  /// At least as long as any border edge that cells make.
  [[nodiscard]] double longest_edge() const { return longest_edge_; }

  /// Calls `visit` with each vertex within `radius`, always in the same order. Looks at kMostLooks
  /// vertices at most, hundreds of times as many as a scan has there: patches of a hostile file may
  /// all lie in one place.
  template <class Visit>
  void for_each_within(glm::dvec3 centre, double radius, const Visit& visit) const {
    constexpr std::uint32_t kMostLooks = 65536;
    std::uint32_t looks = 0;
    const auto look_at = [&](std::span<const std::uint32_t> vertices) {
      for (const std::uint32_t v : vertices) {
        if (++looks > kMostLooks) return;
        const glm::dvec3 d = vertices_[v].position - centre;
        if (d.x * d.x + d.y * d.y + d.z * d.z <= radius * radius) visit(v);
      }
    };
    const Cube low = cubes_.cube_of(centre - radius);
    const Cube high = cubes_.cube_of(centre + radius);
    // Patches whose spacing is far above the mean: there are fewer vertices than cubes.
    if (count(low.x, high.x) * count(low.y, high.y) * count(low.z, high.z) > kMostLooks)
      return look_at(cubes_.all());
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        for (std::int64_t x = low.x; x <= high.x; ++x) look_at(cubes_.in({x, y, z}));
      }
    }
  }

 private:
  [[nodiscard]] static double count(std::int64_t low, std::int64_t high) {
    return static_cast<double>(high) - static_cast<double>(low) + 1.0;
  }

  const std::vector<BorderVertex>& vertices_;
  CubeRuns cubes_;
  double longest_edge_ = 0.0;
};

}  // namespace relief
