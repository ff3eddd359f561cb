#include "preprocess/coarse_scan.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "common/mesh/coarse_mesh.h"
#include "common/mesh/creases.h"
#include "common/mesh/mesh_normals.h"
#include "common/mesh/orient_triangles.h"
#include "common/mesh/sharp_mesh.h"
#include "common/mesh/weld.h"
#include "common/neighbours/neighbours.h"
#include "preprocess/points/keep_points.h"
#include "preprocess/points/on_mesh/spread_on_mesh.h"

namespace relief {
namespace {

// As for textures, which are finer than the points that carry them: a cube has patches of 110 by
// 110 samples, a spacing is a 250th of a gear's width, and a conversion takes half a second.
constexpr std::size_t kFewestPoints = 70'000;
constexpr double kMostAskedFor = 2e6;
// Of a sharp mesh, whose points are dense but for its edges. PSNR and seconds of fandisk (6,475
// points) and anchor (3,793) with 12,000 points: 46.0 dB, 0.14 s, 42.8, 0.12; with 20,000: 48.0,
// 0.17, 44.7, 0.16; 35,000: 48.8, 0.26, 46.4, 0.26; 70,000: 50.6, 0.45, 48.2, 0.45. As scans they
// have 41.4, 0.07 and 35.7, 0.1.
constexpr std::size_t kFewestPointsOfSharp = 35'000;
constexpr std::size_t kPerPointOfSharp = 3;
// Of the mesh of a scan. PSNR, holes in pixels and seconds of a cow (2,903 points) and the Dragon
// (5,205): as they are 37.1, 3,417, 0.09 and 35.7, 4,425, 0.15; 35,000: 45.2, 54, 0.7 and 39.6,
// 1,540, 0.8; 70,000: 46.1, 18, 1.3 and 41.4, 588, 1.5.
constexpr std::size_t kFewestPointsOfScan = 35'000;
// Eight by eight on a face of a box, of which a town has thousands.
constexpr std::size_t kPointsPerSide = 64;
// The share of points on sides of a few points; with more, creases are no order that patches could
// keep to.
constexpr double kMostInSmallSides = 0.1;

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
  drop_values(dropped, sides.of_points);
}

/// 0 without a spacing.
std::size_t points_at_spacing(const Points& mesh, double spacing) {
  if (!(spacing > 0.0)) return 0;
  const double wanted = area_of_triangles(mesh) / (spacing * spacing);
  return static_cast<std::size_t>(std::min(wanted, kMostAskedFor));
}

}  // namespace

std::size_t least_points(const Points& mesh, double spacing) {
  return std::max(kFewestPoints, points_at_spacing(mesh, spacing));
}

std::size_t least_points_of_scan(const Points& scan, double spacing) {
  if (scan.triangles.empty() || scan.size() >= kFewestPointsOfScan) return 0;
  return std::max(kFewestPointsOfScan, points_at_spacing(scan, spacing));
}

Result<std::optional<CoarseScan>> take_coarse_mesh(Points& points, double spacing,
                                                   Progress& progress) {
  const bool is_coarse = is_coarse_mesh(points);
  if (!is_coarse && !is_sharp_mesh(points)) return std::optional<CoarseScan>();
  progress.begin_stage("spread points", 0);
  auto result = std::make_optional<CoarseScan>();
  CoarseScan& coarse = *result;
  coarse.has_own_normals = !points.normals.empty();
  coarse.welded = welded_triangles(points);
  coarse.has_sides = coarse.is_oriented = orient_triangles(points, coarse.welded);
  Points whole;
  whole.positions = points.positions;
  whole.triangles = coarse.welded;
  if (coarse.has_sides) {
    coarse.sides.of_triangles = sides_of_triangles(whole);
    coarse.sides.widths = widths_of_sides(whole, coarse.sides.of_triangles);
  }
  coarse.mesh = std::move(points);
  if (coarse.has_own_normals)
    coarse.mesh.normals = vertex_normals(coarse.mesh);
  else
    split_at_creases(coarse.mesh);
  const std::size_t fewest =
      is_coarse ? kFewestPoints
                : std::max(kFewestPointsOfSharp, kPerPointOfSharp * coarse.mesh.size());
  const std::size_t count =
      std::max({coarse.mesh.size(), fewest, points_at_spacing(coarse.mesh, spacing),
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
