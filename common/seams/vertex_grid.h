// Looks border vertices up by position.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/seams/border_mesh.h"
#include "common/seams/cube_runs.h"

namespace relief {

/// Border vertices in cubes of about three spacings.
class VertexGrid {
 public:
  /// Of those that `holds` is true of.
  VertexGrid(const std::vector<BorderVertex>& vertices,
             const std::function<bool(std::uint32_t)>& holds);
  explicit VertexGrid(const std::vector<BorderVertex>& vertices)
      : VertexGrid(vertices, [](std::uint32_t) { return true; }) {}

  [[nodiscard]] double largest_spacing() const { return largest_spacing_; }

  /// At least as long as any border edge that cells make.
  [[nodiscard]] double longest_edge() const { return longest_edge_; }

  /// A vertex, its position and its normal.
  struct Place {
    glm::dvec3 position{0.0};
    glm::vec3 normal{0.0F};
    std::uint32_t vertex = 0;
  };

  /// Calls `visit` with each place within `radius` and its squared distance, always in the same
  /// order. Looks at kMostLooks vertices at most, hundreds of times as many as a scan has there:
  /// patches of a hostile file may all lie in one place.
  template <class Visit>
  void for_each_within(glm::dvec3 centre, double radius, const Visit& visit) const {
    constexpr std::uint32_t kMostLooks = 65536;
    std::uint32_t looks = 0;
    const auto look_at = [&](CubeRuns::Run run) {
      for (const Place& place : std::span(places_).subspan(run.first, run.count)) {
        if (++looks > kMostLooks) return;
        const glm::dvec3 d = place.position - centre;
        const double squared = d.x * d.x + d.y * d.y + d.z * d.z;
        if (squared <= radius * radius) visit(place, squared);
      }
    };
    const Cube low = cubes_.cube_of(centre - radius);
    const Cube high = cubes_.cube_of(centre + radius);
    // Patches whose spacing is far above the mean: there are fewer vertices than cubes.
    if (count(low.x, high.x) * count(low.y, high.y) * count(low.z, high.z) > kMostLooks)
      return look_at({0, static_cast<std::uint32_t>(places_.size())});
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) look_at(cubes_.in_row(low.x, high.x, y, z));
    }
  }

 private:
  [[nodiscard]] static double count(std::int64_t low, std::int64_t high) {
    return static_cast<double>(high) - static_cast<double>(low) + 1.0;
  }

  CubeRuns cubes_;
  std::vector<Place> places_;  ///< in the order of cubes_
  double largest_spacing_ = 0.0;
  double longest_edge_ = 0.0;
};

}  // namespace relief
