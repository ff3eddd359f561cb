// Finds all points within a radius.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace relief {

class PositionTree;

/// Finds the positions within a radius. Keeps its own copy of the positions, which are finite.
class RadiusSearch {
 public:
  explicit RadiusSearch(const std::vector<glm::dvec3>& positions);
  ~RadiusSearch();
  RadiusSearch(const RadiusSearch&) = delete;
  RadiusSearch& operator=(const RadiusSearch&) = delete;

  /// Fills `found` with the indices of all positions nearer to `centre` than `radius` (world
  /// units), ascending. May be called from several threads at once.
  void find(glm::dvec3 centre, double radius, std::vector<std::uint32_t>& found) const;

 private:
  std::unique_ptr<const PositionTree> tree_;
};

}  // namespace relief
