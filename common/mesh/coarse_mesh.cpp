#include "common/mesh/coarse_mesh.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

#include "common/disjoint_sets.h"

namespace relief {
namespace {

// Triangles with an edge of this many spacings are large. Scans have edges of one or two: 0 to 6 %
// of their area is in large triangles, 39 % of the Buddha's, which was simplified to a twentieth,
// 90 to 100 % of a bracket's, a gear's and a frame of rods.
constexpr double kLongEdge = 4.0;
// With fewer points than this, 40 spacings across a sphere, the spacing is that of so many: a cube
// is coarse.
constexpr double kFewestPoints = 5000.0;

// A body of fewer points is small. Many of them, houses of a town, have short edges beside the
// distance of all points, and no point but corners.
constexpr std::uint32_t kSmallBody = 64;
// A closed surface has two triangles a point, less four for each body: with more than this, bodies
// have more than 64 points on average, and need not be looked for.
constexpr double kTrianglesPerPoint = 2.0 - 4.0 / double{kSmallBody};

bool has_corners(const Points& mesh, const Triangle& t) {
  return std::ranges::all_of(t, [&](std::uint32_t corner) { return corner < mesh.size(); });
}

/// 0 for triangles that a reader would drop.
double area_of(const Points& mesh, const Triangle& t) {
  if (!has_corners(mesh, t)) return 0.0;
  const glm::dvec3 a = mesh.positions[t[0]];
  const double area =
      0.5 * glm::length(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
  return std::isfinite(area) ? area : 0.0;
}

std::vector<double> areas_of(const Points& mesh) {
  std::vector<double> areas(mesh.triangles.size());
  tbb::parallel_for(std::size_t{0}, areas.size(),
                    [&](std::size_t k) { areas[k] = area_of(mesh, mesh.triangles[k]); });
  return areas;
}

double longest_edge(const Points& mesh, const Triangle& t) {
  double longest = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    longest =
        std::max(longest, glm::distance(mesh.positions[t[c]], mesh.positions[t[(c + 1) % 3]]));
  }
  return longest;
}

/// The area of bodies of few points. Lone triangles are no bodies.
double area_of_small_bodies(const Points& mesh) {
  const auto count = static_cast<double>(mesh.triangles.size());
  if (count > kTrianglesPerPoint * static_cast<double>(mesh.size())) return 0.0;
  DisjointSets bodies(mesh.size());
  for (const Triangle& t : mesh.triangles) {
    if (!has_corners(mesh, t)) continue;
    bodies.join(t[0], t[1]);
    bodies.join(t[0], t[2]);
  }
  double area = 0.0;
  for (const Triangle& t : mesh.triangles) {
    if (!has_corners(mesh, t)) continue;
    const std::size_t points = bodies.size(t[0]);
    if (points > 3 && points < kSmallBody) area += area_of(mesh, t);
  }
  return area;
}

}  // namespace

double area_of_triangles(const Points& mesh) {
  const std::vector<double> areas = areas_of(mesh);
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

bool is_coarse_mesh(const Points& mesh) {
  if (mesh.triangles.empty()) return false;  // a large scan needs no table
  std::vector<double> areas = areas_of(mesh);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double points = std::max(static_cast<double>(mesh.size()), kFewestPoints);
  const double limit = kLongEdge * std::sqrt(area / points);
  tbb::parallel_for(std::size_t{0}, areas.size(), [&](std::size_t k) {
    if (areas[k] > 0.0 && !(longest_edge(mesh, mesh.triangles[k]) > limit)) areas[k] = 0.0;
  });
  const double large = std::accumulate(areas.begin(), areas.end(), 0.0);
  return large > 0.5 * area || area_of_small_bodies(mesh) > 0.5 * area;
}

}  // namespace relief
