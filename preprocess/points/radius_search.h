// Finds all points within a radius.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace relief {

/// A search among positions, which the caller keeps alive and unchanged.
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
  struct Tree;
  std::unique_ptr<const Tree> tree_;
};

}  // namespace relief
