// Things in space, sorted into cubes.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "common/flat_map.h"

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

  /// The positions, row by row of cubes along x, cube by cube, in each in ascending order.
  [[nodiscard]] const std::vector<std::uint32_t>& order() const { return order_; }

  /// A part of order().
  struct Run {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
  };

  /// What is in the cubes of a row from one with x at `low_x` to one at `high_x`, and perhaps more:
  /// rows that are 2^32 apart are one, so that what is found is to be measured.
  [[nodiscard]] Run in_row(std::int64_t low_x, std::int64_t high_x, std::int64_t y,
                           std::int64_t z) const;

 private:
  /// A cube that is not empty.
  struct Filled {
    std::int64_t x = 0;
    std::uint32_t first = 0;  ///< in order_
  };

  glm::dvec3 origin_{0.0};
  double side_ = 1.0;
  std::vector<std::uint32_t> order_;
  std::vector<Filled> cubes_;  ///< row by row, in each by x; then one that ends the last
  FlatMap rows_;               ///< to row_firsts_, by y and z
  std::vector<std::uint32_t> row_firsts_;  ///< in cubes_; then one that ends the last
};

}  // namespace relief
