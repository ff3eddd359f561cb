// Looks border vertices up by position.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

#include "common/seams/border_mesh.h"

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
    const auto look_at = [&](std::uint32_t first, std::uint32_t end) {
      for (std::uint32_t k = first; k < end && looks < kMostLooks; ++k, ++looks) {
        const glm::dvec3 d = vertices_[order_[k]].position - centre;
        if (d.x * d.x + d.y * d.y + d.z * d.z <= radius * radius) visit(order_[k]);
      }
    };
    const Cube low = cube_of(centre - radius);
    const Cube high = cube_of(centre + radius);
    // Patches whose spacing is far above the mean: there are fewer vertices than cubes.
    if (count(low.x, high.x) * count(low.y, high.y) * count(low.z, high.z) > kMostLooks)
      return look_at(0, static_cast<std::uint32_t>(order_.size()));
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          const auto found = runs_.find(key_of({x, y, z}));
          if (found != runs_.end()) look_at(found->second.first, found->second.end);
        }
      }
    }
  }

 private:
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t end = 0;
  };
  struct Cube {
    std::int64_t x = 0;
    std::int64_t y = 0;
    std::int64_t z = 0;
  };
  [[nodiscard]] Cube cube_of(glm::dvec3 position) const;
  [[nodiscard]] static double count(std::int64_t low, std::int64_t high) {
    return static_cast<double>(high) - static_cast<double>(low) + 1.0;
  }
  /// Cubes that are 2^21 apart share a key: what is visited is measured.
  [[nodiscard]] static std::uint64_t key_of(const Cube& cube) {
    constexpr std::uint64_t mask = (1U << 21U) - 1;
    return ((static_cast<std::uint64_t>(cube.x) & mask) << 42U) |
           ((static_cast<std::uint64_t>(cube.y) & mask) << 21U) |
           (static_cast<std::uint64_t>(cube.z) & mask);
  }

  const std::vector<BorderVertex>& vertices_;
  glm::dvec3 origin_{0.0};
  double side_ = 1.0;
  double longest_edge_ = 0.0;
  std::vector<std::uint32_t> order_;
  std::unordered_map<std::uint64_t, Run> runs_;
};

}  // namespace relief
