#include "preprocess/partition/region_cells.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>

#include "preprocess/points/complete_frame.h"

namespace relief {

RegionCells::RegionCells(const SurfaceSamples& samples, const std::vector<Region>& regions)
    : samples_(samples),
      planes_(regions.size()),
      owner_(samples.positions.size(), kNone),
      keys_(samples.positions.size(), 0),
      first_(std::bit_ceil(samples.positions.size() + 1), kNone),
      next_(samples.positions.size(), kNone) {
  tbb::parallel_for(std::size_t{0}, regions.size(), [&](std::size_t r) {
    planes_[r] = plane_of(regions[r]);
    for (const std::uint32_t i : regions[r].points) {
      owner_[i] = static_cast<std::uint32_t>(r);
      keys_[i] = key_of(i, owner_[i]);
    }
  });
  for (std::uint32_t i = 0; i < owner_.size(); ++i) {
    if (owner_[i] != kNone) insert(i);
  }
}

RegionCells::Plane RegionCells::plane_of(const Region& region) const {
  Plane plane;
  plane.normal = region.normal;
  plane.base = samples_.positions[region.points.front()];
  const SheetScale scale = sheet_scale(samples_, region.points, kSheetTolerance);
  plane.tolerance = scale.tolerance;
  complete_frame(glm::dvec3(region.normal), plane.u, plane.v);
  plane.u /= scale.cell;
  plane.v /= scale.cell;
  return plane;
}

std::uint64_t RegionCells::key_of(std::uint32_t point, std::uint32_t region) const {
  // 20 bits for each coordinate: a cell a million cells away may collide, which only refuses the
  // move.
  constexpr std::uint64_t bits = (1U << 20U) - 1U;
  const Plane& plane = planes_[region];
  const glm::dvec3 d = samples_.positions[point] - plane.base;
  const auto x = static_cast<std::int64_t>(std::floor(glm::dot(d, plane.u)));
  const auto y = static_cast<std::int64_t>(std::floor(glm::dot(d, plane.v)));
  return std::uint64_t{region} << 40U | (static_cast<std::uint64_t>(x) & bits) << 20U |
         (static_cast<std::uint64_t>(y) & bits);
}

std::size_t RegionCells::slot_of(std::uint64_t key) const {
  // The product's high bits depend on all bits of the key, the region's included.
  return (key * 0x9E3779B97F4A7C15ULL >> 32U) & (first_.size() - 1);
}

void RegionCells::insert(std::uint32_t point) {
  std::uint32_t& first = first_[slot_of(keys_[point])];
  next_[point] = first;
  first = point;
}

void RegionCells::remove(std::uint32_t point) {
  std::uint32_t* at = &first_[slot_of(keys_[point])];
  while (*at != point) at = &next_[*at];
  *at = next_[point];
}

bool RegionCells::is_on_its_sheet(std::uint32_t point, std::uint32_t region) const {
  const std::uint64_t key = key_of(point, region);
  for (std::uint32_t o = first_[slot_of(key)]; o != kNone; o = next_[o]) {
    if (keys_[o] != key || o == point) continue;
    const glm::dvec3 apart = samples_.positions[point] - samples_.positions[o];
    const glm::vec3 mean = glm::normalize(samples_.normals[point] + samples_.normals[o]);
    if (std::abs(glm::dot(glm::dvec3(mean), apart)) > planes_[region].tolerance) return false;
  }
  return true;
}

void RegionCells::move(std::uint32_t point, std::uint32_t region) {
  remove(point);
  owner_[point] = region;
  keys_[point] = key_of(point, region);
  insert(point);
}

}  // namespace relief
