#include "preprocess/resample/creases.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <unordered_set>
#include <utility>

namespace relief {
namespace {

constexpr std::size_t kFewestOwn = 4;
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

/// Points of other regions that the neighbour graph reaches from a region's own within `reach`.
PatchPoints collect_beyond(const ScanSurface& scan, const Region& region, const PatchFrame& frame,
                           double reach) {
  const SurfaceSamples& samples = scan.samples;
  const std::vector<std::uint32_t>& region_of = scan.membership.region;
  PatchPoints out;
  out.frame = frame;
  struct Reached {
    std::uint32_t point;
    std::uint32_t from;  // the region's own point
  };
  const std::uint32_t own = region_of[region.points.front()];
  std::unordered_set<std::uint32_t> seen;
  std::vector<Reached> front;
  for (const std::uint32_t i : region.points) front.push_back({i, i});
  while (!front.empty()) {
    std::vector<Reached> next;
    for (const auto& [i, from] : front) {
      for (const std::uint32_t j : scan.graph.of(i)) {
        if (region_of[j] == own || seen.contains(j)) continue;
        if (glm::distance(samples.positions[j], samples.positions[from]) > reach) continue;
        seen.insert(j);
        next.push_back({j, from});
        out.ids.push_back(j);
      }
    }
    front = std::move(next);
  }
  std::sort(out.ids.begin(), out.ids.end());
  const glm::mat3 to_local(glm::transpose(frame.axes));
  for (const std::uint32_t i : out.ids) {
    out.positions.push_back(frame.to_local(samples.positions[i]));
    out.normals.push_back(to_local * scan.creases->normals[i]);
    out.spacing.push_back(samples.spacing[i]);
  }
  return out;
}

}  // namespace

RegionCreases::RegionCreases(const ScanSurface& scan, const Region& region,
                             const PatchPoints& points, double reach)
    : reach_(reach) {
  const CreaseNormals& sides = *scan.creases;
  const bool at_crease =
      std::ranges::any_of(region.points, [&](std::uint32_t i) { return sides.at_crease[i] != 0; });
  if (!at_crease) return;
  others_ = collect_beyond(scan, region, points.frame, reach);
  if (others_.size() == 0) return;
  points_ = points;
  const glm::mat3 to_local(glm::transpose(points.frame.axes));
  for (std::size_t p = 0; p < points_.size(); ++p)
    points_.normals[p] = to_local * sides.normals[points_.ids[p]];
  own_.emplace(points_, points_.own, reach);
  beyond_.emplace(others_, others_.size(), reach);
}

std::optional<Crease> RegionCreases::near(glm::dvec3 position, glm::vec3 normal) const {
  // Most nodes are done with here: nothing turns.
  constexpr float kSlightTurn = 0.94F;
  bool turns = false;
  beyond_->for_each_within(position.x, position.y, reach_, [&](std::uint32_t p, double) {
    turns = turns || glm::dot(others_.normals[p], normal) < kSlightTurn;
  });
  if (!turns) return {};
  const std::vector<OrientedPoint> own =
      points_near(points_, *own_, position, reach_, [](std::uint32_t) { return true; });
  std::optional<CreaseSide> here = most_shown_side(own, kFewestOwn);
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
