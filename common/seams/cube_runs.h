// Things in space, sorted into cubes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <unordered_map>
#include <vector>

namespace relief {

/// A cube of a grid over all of space.
struct Cube {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;
};

/// The indices of some positions, cube by cube.
class CubeRuns {
 public:
  CubeRuns() = default;
  /// `side`: of a cube, world units. A corner of cubes is at the first position.
  CubeRuns(std::span<const glm::dvec3> positions, double side);

  /// The cube of a position; of one that is too far away, or not a number, one that is far away.
  [[nodiscard]] Cube cube_of(glm::dvec3 position) const;

  /// The positions in a cube, in ascending order, and perhaps others: cubes that are 2^21 apart
  /// share a run, so that what is found is to be measured.
  [[nodiscard]] std::span<const std::uint32_t> in(const Cube& cube) const;

  /// All positions.
  [[nodiscard]] std::span<const std::uint32_t> all() const { return order_; }

 private:
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  glm::dvec3 origin_{0.0};
  double side_ = 1.0;
  std::vector<std::uint32_t> order_;
  std::unordered_map<std::uint64_t, Run> runs_;
};

}  // namespace relief
