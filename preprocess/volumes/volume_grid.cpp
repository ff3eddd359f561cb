#include "preprocess/volumes/volume_grid.h"

#include <unistd.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace relief {
namespace {

/// Far beyond any unit of length, and far from where squares overflow or vanish.
constexpr double kLargestCoordinate = 1e30;
constexpr double kShortestStep = 1e-30;
/// Volume that three steps span, as a share of a box with their lengths: gantries tilt scans by 30
/// degrees at most (0.87), and rounding to six digits gives 1e-6.
constexpr double kFlattestSteps = 1e-5;

bool is_coordinate(const glm::dvec3& p) {
  // False for NaN.
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate &&
         std::abs(p.z) <= kLargestCoordinate;
}

std::uint64_t half_of_memory() {
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
         static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE)) / 2;
}

}  // namespace

Result<glm::uvec3> checked_size(const std::string& name, const std::array<std::int64_t, 3>& size,
                                std::uint64_t bytes_each) {
  for (const std::int64_t nodes : size) {
    if (nodes < 1 || nodes > std::numeric_limits<std::int32_t>::max()) {
      return make_error("{}: states a size of {} x {} x {}; each must be 1 to 2147483647", name,
                        size[0], size[1], size[2]);
    }
  }
  const auto layer = static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]);
  const std::uint64_t most = half_of_memory() / bytes_each;
  if (layer > most / static_cast<std::uint64_t>(size[2])) {
    return make_error(
        "{}: states a size of {} x {} x {}, which would take more than half of this "
        "machine's memory; crop or downsample it",
        name, size[0], size[1], size[2]);
  }
  return glm::uvec3(size[0], size[1], size[2]);
}

Result<RegularGrid> checked_grid(const std::string& name, const RegularGrid& grid,
                                 const FileFrame& frame) {
  RegularGrid placed = grid;
  placed.origin *= frame.signs;
  if (!is_coordinate(placed.origin)) {
    return make_error("{}: its origin ({}, {}, {}) is not a position; correct the header", name,
                      grid.origin.x, grid.origin.y, grid.origin.z);
  }
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const glm::dvec3& step = grid.step[axis];
    if (!is_coordinate(step) || !(glm::length(step) >= kShortestStep)) {
      return make_error(
          "{}: its step along axis {} is ({}, {}, {}), which is not a step in space; correct the "
          "header's spacing or directions",
          name, axis, step.x, step.y, step.z);
    }
    placed.step[axis] = step * frame.signs;
  }
  const glm::dmat3 unit(glm::normalize(placed.step[0]), glm::normalize(placed.step[1]),
                        glm::normalize(placed.step[2]));
  if (!(std::abs(glm::determinant(unit)) >= kFlattestSteps)) {
    return make_error(
        "{}: its steps along the three axes lie in one plane (their matrix is singular); correct "
        "the header's directions",
        name);
  }
  return placed;
}

Result<ScalarVolume> make_volume(const std::string& name, const std::array<std::int64_t, 3>& size,
                                 const RegularGrid& grid, const FileFrame& frame) {
  ScalarVolume volume;
  RELIEF_TRY_ASSIGN(volume.size, checked_size(name, size));
  RELIEF_TRY_ASSIGN(volume.placement, checked_grid(name, grid, frame));
  volume.stance = frame.is_anatomical ? kAnatomicalStance : kZUp;
  return volume;
}

}  // namespace relief
