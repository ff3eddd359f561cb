#include "preprocess/points/thin.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <tuple>
#include <vector>

#include "preprocess/points/keep_points.h"

namespace relief {
namespace {

/// The cube's number along each axis. Not rounded below 2^53; beyond it cubes are finer than
/// coordinates.
glm::dvec3 cube_of(glm::dvec3 p, double spacing) {
  return glm::floor(p / spacing);
}

/// Points of one cube are adjacent, in the order of the file.
std::vector<std::uint32_t> by_cube(const std::vector<glm::dvec3>& positions, double spacing) {
  std::vector<std::uint32_t> order(positions.size());
  std::iota(order.begin(), order.end(), 0U);
  tbb::parallel_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::dvec3 p = cube_of(positions[a], spacing);
    const glm::dvec3 q = cube_of(positions[b], spacing);
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  return order;
}

}  // namespace

std::uint64_t thin_points(Points& points, double spacing) {
  const std::vector<glm::dvec3>& positions = points.positions;
  const auto is_lost = [&](glm::dvec3 p) { return !std::isfinite(glm::length(p / spacing)); };
  // Cubes that doubles cannot number are smaller than any distance between points.
  if (std::ranges::any_of(positions, is_lost)) return 0;
  const std::vector<std::uint32_t> order = by_cube(positions, spacing);
  std::vector<std::uint8_t> dropped(positions.size(), 1);
  for (auto first = order.begin(); first != order.end();) {
    const glm::dvec3 cube = cube_of(positions[*first], spacing);
    const auto last = std::find_if(first, order.end(), [&](std::uint32_t i) {
      return cube_of(positions[i], spacing) != cube;
    });
    glm::dvec3 offsets(0.0);  // from the first, so that far coordinates keep their digits
    for (auto i = first; i != last; ++i) offsets += positions[*i] - positions[*first];
    const glm::dvec3 mean = positions[*first] + offsets / static_cast<double>(last - first);
    dropped[*std::min_element(first, last, [&](std::uint32_t a, std::uint32_t b) {
      return glm::distance(positions[a], mean) < glm::distance(positions[b], mean);
    })] = 0;
    first = last;
  }
  return drop_points(points, dropped);
}

}  // namespace relief
