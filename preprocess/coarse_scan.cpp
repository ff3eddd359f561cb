#include "preprocess/coarse_scan.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "common/mesh/coarse_mesh.h"
#include "common/mesh/creases.h"
#include "common/mesh/mesh_edges.h"
#include "common/mesh/mesh_normals.h"
#include "common/neighbours/neighbours.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/points/seen_positions.h"
#include "preprocess/points/spread_on_mesh.h"

namespace relief {
namespace {

// As for textures, which are finer than the points that carry them: a cube has patches of 110 by
// 110 samples, a spacing is a 250th of a gear's width, and a conversion takes half a second.
constexpr std::size_t kFewestPoints = 70'000;
constexpr double kMostAskedFor = 2e6;
// Eight by eight on a face of a box, of which a town has thousands.
constexpr std::size_t kPointsPerSide = 64;
// The share of points on sides of a few points; with more, creases are no order that patches could
// keep to.
constexpr double kMostInSmallSides = 0.1;

/// The triangles with the first point of each position.
std::vector<Triangle> weld(const Points& mesh) {
  SeenPositions seen(mesh.size());
  std::vector<std::uint32_t> first;
  first.reserve(mesh.size());
  for (std::uint32_t i = 0; i < mesh.size(); ++i)
    first.push_back(seen.find_or_add(mesh.positions, i));
  std::vector<Triangle> welded = mesh.triangles;
  for (Triangle& t : welded) {
    for (std::uint32_t& corner : t) corner = first[corner];
  }
  return welded;
}

/// The points that sides of two triangles and more ask for.
std::size_t points_for_sides(const std::vector<std::uint32_t>& of_triangles) {
  std::map<std::uint32_t, std::size_t> counts;
  for (const std::uint32_t side : of_triangles) ++counts[side];
  const auto sides = static_cast<std::size_t>(
      std::ranges::count_if(counts, [](const auto& count) { return count.second > 1; }));
  return std::min(kPointsPerSide * sides, static_cast<std::size_t>(kMostAskedFor));
}

/// Finds the sides of points that lie on these triangles, and drops points of small ones; the
/// patches around close over those. Patches keep to no sides if there is one only, or if much of a
/// crumpled mesh is small ones.
void keep_large_sides(const std::vector<std::uint32_t>& triangles, CoarseScan& coarse,
                      Points& points) {
  MeshSides& sides = coarse.sides;
  for (const std::uint32_t t : triangles) sides.of_points.push_back(sides.of_triangles[t]);
  const std::vector<std::uint8_t> dropped = take_small_sides(sides);
  const auto count = static_cast<std::size_t>(std::ranges::count(dropped, 1));
  const std::set<std::uint32_t> numbers(sides.of_points.begin(), sides.of_points.end());
  coarse.has_sides =
      numbers.size() > 1 &&
      static_cast<double>(count) <= kMostInSmallSides * static_cast<double>(points.size());
  if (!coarse.has_sides) return;
  drop_points(points, dropped);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < dropped.size(); ++i) {
    if (dropped[i] == 0) sides.of_points[kept++] = sides.of_points[i];
  }
  sides.of_points.resize(kept);
}

}  // namespace

std::size_t least_points(const Points& mesh, double spacing) {
  if (!(spacing > 0.0)) return kFewestPoints;
  const double wanted = area_of_triangles(mesh) / (spacing * spacing);
  return std::max(kFewestPoints, static_cast<std::size_t>(std::min(wanted, kMostAskedFor)));
}

Result<std::optional<CoarseScan>> take_coarse_mesh(Points& points, double spacing,
                                                   Progress& progress) {
  if (!is_coarse_mesh(points)) return std::optional<CoarseScan>();
  progress.begin_stage("spread points", 0);
  auto result = std::make_optional<CoarseScan>();
  CoarseScan& coarse = *result;
  coarse.has_own_normals = !points.normals.empty();
  Points whole;
  whole.positions = points.positions;
  whole.triangles = coarse.welded = weld(points);
  coarse.is_oriented = MeshEdges(whole).misoriented() < kMaxMisoriented;
  coarse.has_sides = coarse.is_oriented;
  if (coarse.has_sides) coarse.sides.of_triangles = sides_of_triangles(whole);
  coarse.mesh = std::move(points);
  if (coarse.has_own_normals)
    coarse.mesh.normals = vertex_normals(coarse.mesh);
  else
    split_at_creases(coarse.mesh);
  const std::size_t count = std::max({coarse.mesh.size(), least_points(coarse.mesh, spacing),
                                      points_for_sides(coarse.sides.of_triangles)});
  SpreadPoints spread = spread_on_mesh(coarse.mesh, count, progress);
  if (progress.cancelled()) return interrupted_error();
  points = std::move(spread.points);
  if (coarse.has_sides) keep_large_sides(spread.triangles, coarse, points);
  if (points.size() < kMinSurfacePoints)
    return make_error("the triangles have no area that points could be spread over");
  return result;
}

}  // namespace relief
