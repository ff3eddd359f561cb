#include "renderer/engines/ewa/splat_hierarchy.h"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <span>
#include <utility>

#include "common/median.h"

namespace relief::ewa {
namespace {

constexpr std::size_t kFewPoints = 256;
/// A level that keeps more than this share of the points it is made of is not worth its memory.
constexpr double kMinShrinking = 0.7;
/// Bits of a cell's number along each axis: three and an octant fit 63.
constexpr double kMaxCells = 1 << 20;

/// A point and the cell that it lies in.
struct Placed {
  std::uint64_t cell = 0;
  std::uint32_t point = 0;
};

bool is_point(const SplatCloud& cloud, std::size_t k) {
  const glm::dvec3& p = cloud.positions[k];
  const glm::vec3& n = cloud.normals[k];
  return std::isfinite(p.x + p.y + p.z) && std::isfinite(n.x + n.y + n.z) &&
         std::isfinite(cloud.radii[k]) && cloud.radii[k] > 0.0;
}

/// The least cell that the points' extent leaves countable is 2^-20 of it.
struct Lattice {
  glm::dvec3 low{std::numeric_limits<double>::max()};
  glm::dvec3 high{std::numeric_limits<double>::lowest()};
  double least_cell = 0.0;
  double radius = 0.0;  ///< median
};

Lattice find_lattice(const SplatCloud& cloud) {
  Lattice lattice;
  std::vector<double> radii;
  for (std::size_t k = 0; k < cloud.positions.size(); ++k) {
    if (!is_point(cloud, k)) continue;
    lattice.low = glm::min(lattice.low, cloud.positions[k]);
    lattice.high = glm::max(lattice.high, cloud.positions[k]);
    radii.push_back(cloud.radii[k]);
  }
  if (radii.empty()) return lattice;
  lattice.radius = median_of(std::move(radii));
  const glm::dvec3 extent = lattice.high - lattice.low;
  lattice.least_cell = std::max({extent.x, extent.y, extent.z}) / (kMaxCells - 1.0);
  return lattice;
}

std::vector<Placed> place_points(const SplatCloud& cloud, const Lattice& lattice, double cell) {
  std::vector<Placed> placed;
  for (std::size_t k = 0; k < cloud.positions.size(); ++k) {
    if (!is_point(cloud, k)) continue;
    const glm::dvec3 at = (cloud.positions[k] - lattice.low) / cell;
    const glm::vec3& n = cloud.normals[k];
    std::uint64_t key = (n.x < 0.0F ? 1U : 0U) + (n.y < 0.0F ? 2U : 0U) + (n.z < 0.0F ? 4U : 0U);
    for (glm::length_t axis = 0; axis < 3; ++axis)
      key = (key << 20U) | static_cast<std::uint64_t>(at[axis]);
    placed.push_back({key, static_cast<std::uint32_t>(k)});
  }
  tbb::parallel_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return std::pair(a.cell, a.point) < std::pair(b.cell, b.point);
  });
  return placed;
}

/// Appends one cluster of points of `from`.
void append_cluster(const SplatCloud& from, std::span<const Placed> members, SplatCloud& to) {
  double area = 0.0;
  glm::dvec3 position(0.0);
  glm::dvec3 normal(0.0);
  glm::dvec4 colour(0.0);
  const glm::dvec3 base = from.positions[members.front().point];
  for (const auto [cell, k] : members) {
    const double own = from.radii[k] * from.radii[k];
    area += own;
    position += own * (from.positions[k] - base);
    normal += own * glm::dvec3(from.normals[k]);
    if (!from.colours.empty()) colour += own * glm::dvec4(from.colours[k]);
  }
  position = base + position / area;
  double reach = 0.0;
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = members.front().point;
  for (const auto [cell, k] : members) {
    const double distance = glm::distance(position, from.positions[k]);
    // Half the diagonal of the square that the point stands for.
    reach = std::max(reach, distance + from.radii[k] * std::sqrt(0.5));
    if (distance < least) {
      least = distance;
      nearest = k;
    }
  }
  const double length = glm::length(normal);
  to.positions.push_back(position);
  to.normals.push_back(length > 0.0 ? glm::vec3(normal / length) : from.normals[nearest]);
  to.radii.push_back(std::max(std::sqrt(area), reach));
  if (!from.colours.empty()) to.colours.emplace_back(colour / area);
  if (!from.uvs.empty()) to.uvs.push_back(from.uvs[nearest]);
  if (!from.patches.empty()) to.patches.push_back(from.patches[nearest]);
  if (!from.materials.empty()) to.materials.push_back(from.materials[nearest]);
}

SplatCloud coarsen(const SplatCloud& from, const Lattice& lattice, double cell) {
  const std::vector<Placed> placed = place_points(from, lattice, cell);
  SplatCloud coarse;
  for (std::size_t begin = 0; begin < placed.size();) {
    std::size_t end = begin + 1;
    while (end < placed.size() && placed[end].cell == placed[begin].cell) ++end;
    append_cluster(from, std::span(placed).subspan(begin, end - begin), coarse);
    begin = end;
  }
  return coarse;
}

}  // namespace

SplatHierarchy build_hierarchy(SplatCloud cloud) {
  const Lattice lattice = find_lattice(cloud);
  SplatHierarchy hierarchy;
  hierarchy.levels.push_back(std::move(cloud));
  for (double cell = std::max(2.0 * lattice.radius, lattice.least_cell);; cell *= 2.0) {
    const SplatCloud& finer = hierarchy.levels.back();
    if (finer.positions.size() <= kFewPoints) break;
    SplatCloud coarse = coarsen(finer, lattice, cell);
    const auto limit = kMinShrinking * static_cast<double>(finer.positions.size());
    if (coarse.positions.empty() || static_cast<double>(coarse.positions.size()) > limit) break;
    hierarchy.levels.push_back(std::move(coarse));
  }
  return hierarchy;
}

std::size_t level_of_size(const SplatHierarchy& hierarchy, const View& view, double pixels) {
  const double scale = 0.5 * view.height / view.slope_y;
  for (std::size_t level = hierarchy.levels.size(); level-- > 1;) {
    const SplatCloud& cloud = hierarchy.levels[level];
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t k = 0; k < cloud.positions.size(); ++k) {
      const double depth = -(view.rotation * (cloud.positions[k] - view.eye)).z;
      if (!(depth > view.near)) continue;
      sum += cloud.radii[k] * scale / (view.orthographic ? 1.0 : depth);
      count += 1.0;
    }
    if (count > 0.0 && sum <= pixels * count) return level;
  }
  return 0;
}

}  // namespace relief::ewa
