// Whether a point may join a region that others leave and join: a table of who lies where.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// The points of all regions, each in its cell of its region's base plane. What RegionTest asks of
/// a whole region it asks of one point that wants in.
class RegionCells {
 public:
  RegionCells(const SurfaceSamples& samples, const std::vector<Region>& regions);

  /// A point's region; kNone where it is in none.
  [[nodiscard]] std::uint32_t owner(std::uint32_t point) const { return owner_[point]; }
  [[nodiscard]] std::size_t size() const { return owner_.size(); }
  [[nodiscard]] glm::vec3 normal(std::uint32_t region) const { return planes_[region].normal; }

  /// Whether the point lies on one sheet with the region's points in its cell.
  [[nodiscard]] bool is_on_its_sheet(std::uint32_t point, std::uint32_t region) const;

  /// Moves a point from its region to another one.
  void move(std::uint32_t point, std::uint32_t region);

  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;

 private:
  struct Plane {
    glm::dvec3 base{0.0};
    glm::dvec3 u{0.0};  // over the side of a cell
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
  std::vector<std::uint64_t> keys_;   // of each point: its region and its cell
  std::vector<std::uint32_t> first_;  // of each slot: a point of it
  std::vector<std::uint32_t> next_;   // of each point: another one of its slot
};

}  // namespace relief
