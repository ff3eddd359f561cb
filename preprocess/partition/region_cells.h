// Tests whether a point may join a region while others leave and join it.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/partition/region.h"
#include "preprocess/partition/region_criteria.h"

namespace relief {

/// The points of all regions, in cells of their region's base plane. Applies RegionTest's test of a
/// whole region to a single point that may join.
class RegionCells {
 public:
  RegionCells(const SurfaceSamples& samples, const std::vector<Region>& regions);

  /// Returns a point's region; kNone if it is in none.
  [[nodiscard]] std::uint32_t owner(std::uint32_t point) const { return owner_[point]; }
  [[nodiscard]] std::size_t size() const { return owner_.size(); }
  [[nodiscard]] glm::vec3 normal(std::uint32_t region) const { return planes_[region].normal; }

  /// Returns whether the point lies on one sheet with the region's points in its cell.
  [[nodiscard]] bool is_on_its_sheet(std::uint32_t point, std::uint32_t region) const;

  /// Moves a point to another region.
  void move(std::uint32_t point, std::uint32_t region);

  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

 private:
  struct Plane {
    glm::dvec3 base{0.0};
    glm::dvec3 u{0.0};  // divided by the side of a cell
    glm::dvec3 v{0.0};
    glm::vec3 normal{0.0F};
    double tolerance = 0.0;
  };

  [[nodiscard]] Plane plane_of(const Region& region) const;
  [[nodiscard]] std::uint64_t key_of(std::uint32_t point, std::uint32_t region) const;
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const;
  void insert(std::uint32_t point);
  void remove(std::uint32_t point);

  SurfaceSamples samples_;
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> owner_;
  std::vector<std::uint64_t> keys_;   // region and cell of each point
  std::vector<std::uint32_t> first_;  // a point of each slot
  std::vector<std::uint32_t> next_;   // another point of each point's slot
};

}  // namespace relief
