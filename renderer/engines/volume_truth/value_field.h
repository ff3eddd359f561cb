// The values of a regular grid at any place, by trilinear interpolation.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/progress.h"
#include "common/volume/scalar_volume.h"

namespace relief::volume_truth {

/// Values, from and to.
struct ValueRange {
  float low = 0.0F;
  float high = -1.0F;  ///< below `low`: there are none

  [[nodiscard]] bool is_empty() const { return !(low <= high); }
};

/// Cells along each side of a block, whose range of values is kept.
inline constexpr int kBlock = 8;

class ValueField {
 public:
  struct Sample {
    double value = 0.0;
    glm::dvec3 gradient{0.0};  ///< world
  };

  /// `volume` outlives it and has a regular grid. Incomplete if `progress` is cancelled.
  ValueField(const ScalarVolume& volume, const Progress& progress);

  /// Cells along each axis; none along one with a single layer of nodes.
  [[nodiscard]] glm::ivec3 cells() const { return glm::ivec3(volume_->size) - 1; }
  /// Range of the values at a cell's corners; empty if one of them has no value.
  [[nodiscard]] ValueRange range_of_cell(glm::ivec3 cell) const;
  /// Range of all cells in the cell's block.
  [[nodiscard]] const ValueRange& range_of_block(glm::ivec3 cell) const;
  /// At a place (the grid's coordinates) in a cell whose corners have values.
  [[nodiscard]] double value_at(glm::ivec3 cell, glm::dvec3 place) const;
  /// Likewise with the gradient, interpolated between those at the nodes.
  [[nodiscard]] Sample sample_at(glm::ivec3 cell, glm::dvec3 place) const;

 private:
  [[nodiscard]] std::size_t index(glm::ivec3 node) const;
  template <class T, class At>
  [[nodiscard]] T interpolated(glm::ivec3 cell, glm::dvec3 place, const At& at) const;

  const ScalarVolume* volume_;
  std::vector<glm::vec3> gradients_;
  glm::ivec3 blocks_{0};
  std::vector<ValueRange> ranges_;
};

}  // namespace relief::volume_truth
