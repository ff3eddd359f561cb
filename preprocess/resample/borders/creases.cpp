#include "preprocess/resample/borders/creases.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <utility>

#include "preprocess/resample/surroundings/grow_region.h"

namespace relief {
namespace {

// The nearest of so many points are looked at, which bounds the work where scans overlap.
constexpr std::size_t kMostPoints = 48;

// As many other sides are looked at: at a corner there are two.
constexpr int kMostSides = 3;
// Sides whose normals turn by 17 degrees less than 180 are those of a thin sheet.
constexpr double kLeastSine = 0.3;

/// The points of a lookup within `reach` of a position that `wanted` lets in; the nearest.
template <class Wanted>
std::vector<OrientedPoint> points_near(const PatchPoints& points, const PointGrid& lookup,
                                       glm::dvec3 position, double reach, const Wanted& wanted) {
  std::vector<std::pair<double, std::uint32_t>> found;
  lookup.for_each_within(position.x, position.y, reach, [&](std::uint32_t p, double squared) {
    const double dz = points.positions[p].z - position.z;
    squared += dz * dz;
    if (squared <= reach * reach && wanted(p)) found.emplace_back(squared, p);
  });
  std::sort(found.begin(), found.end());
  found.resize(std::min(found.size(), kMostPoints));
  std::vector<OrientedPoint> nearest;
  nearest.reserve(found.size());
  for (const auto& [squared, p] : found)
    nearest.push_back({points.positions[p], points.normals[p]});
  return nearest;
}

}  // namespace

RegionCreases::RegionCreases(const ScanSurface& scan, const Region& region,
                             const PatchPoints& points, double reach)
    : reach_(reach) {
  const CreaseNormals& creases = *scan.creases;
  const bool at_crease = std::ranges::any_of(
      region.points, [&](std::uint32_t i) { return creases.at_crease[i] != 0; });
  if (!at_crease) return;
  const SurfaceSamples sides{scan.samples.positions, creases.normals, scan.samples.spacing,
                             scan.samples.roughness};
  const auto is_near = [&](std::uint32_t from, std::uint32_t, std::uint32_t j) {
    return glm::distance(sides.positions[j], sides.positions[from]) <= reach;
  };
  others_.frame = points.frame;
  grow_region(scan.graph, region, scan.membership.region, is_near, others_.ids);
  if (others_.size() == 0) return;
  std::sort(others_.ids.begin(), others_.ids.end());
  place_points(sides, others_);
  points_.frame = points.frame;
  points_.own = points.own;
  points_.supporting = points.supporting;
  points_.ids = points.ids;
  place_points(sides, points_);
  own_.emplace(points_, points_.own, reach);
  beyond_.emplace(others_, others_.size(), reach);
}

std::optional<Crease> RegionCreases::near(glm::dvec3 position, glm::vec3 normal) const {
  // Most nodes are done with here: nothing turns.
  bool turns = false;
  beyond_->for_each_within(position.x, position.y, reach_, [&](std::uint32_t p, double) {
    turns = turns || glm::dot(others_.normals[p], normal) < kSlightTurnCosine;
  });
  if (!turns) return {};
  const std::vector<OrientedPoint> own =
      points_near(points_, *own_, position, reach_, [](std::uint32_t) { return true; });
  std::optional<CreaseSide> here = most_shown_side(own, kFewestOfNearSide);
  if (!here) return {};
  std::vector<OrientedPoint> turned =
      points_near(others_, *beyond_, position, reach_, [&](std::uint32_t p) {
        return glm::dot(others_.normals[p], here->normal) < kCreaseTurnCosine;
      });
  std::optional<Crease> crease;
  for (int side = 0; side < kMostSides; ++side) {
    const std::optional<CreaseSide> there = farthest_side(turned, here->normal);
    if (!there) break;
    // Those that looked like this side may have been of the crease itself.
    if (const auto again = farthest_side(own, there->normal)) here = again;
    std::erase_if(turned, [&](const OrientedPoint& p) {
      return glm::dot(p.normal, there->normal) >= kCreaseTurnCosine;
    });
    const double cosine = glm::dot(here->normal, there->normal);
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    if (cosine > kCreaseTurnCosine || sine < kLeastSine) continue;
    const glm::dvec3 n(there->normal);
    const double inside = glm::dot(here->middle - there->middle, n);
    const double at = glm::dot(position - there->middle, n);
    const double distance = (inside < 0.0 ? -at : at) / sine;
    if (!crease || distance < crease->distance) crease = Crease{*here, distance};
  }
  return crease;
}

}  // namespace relief
