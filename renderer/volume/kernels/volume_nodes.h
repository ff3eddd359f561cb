// Where a volume's nodes are, how far apart, and how the values change there.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/volume/scalar_volume.h"

namespace relief {

/// Nodes of a grid by their indices. Not of scattered points, which have no grid.
class VolumeNodes {
 public:
  /// `volume` outlives it and has a grid.
  explicit VolumeNodes(const ScalarVolume& volume);

  [[nodiscard]] const ScalarVolume& volume() const { return *volume_; }
  [[nodiscard]] std::size_t index(glm::uvec3 node) const {
    return node.x + std::size_t{volume_->size.x} * (node.y + std::size_t{volume_->size.y} * node.z);
  }
  [[nodiscard]] float value(glm::uvec3 node) const { return volume_->values[index(node)]; }

  /// World.
  [[nodiscard]] glm::dvec3 position(glm::uvec3 node) const;
  /// Columns: the steps from node to node along i, j and k, by central differences (world units).
  [[nodiscard]] glm::dmat3 step(glm::uvec3 node) const;
  /// Whether the step is the same everywhere.
  [[nodiscard]] bool is_regular() const;
  /// The change of the value for a world unit, by central differences at the nodes; at the border
  /// and beside a node without value by one-sided ones.
  [[nodiscard]] glm::dvec3 gradient(glm::uvec3 node) const;

 private:
  const ScalarVolume* volume_;
  glm::dmat3 inverse_step_{1.0};  ///< of a regular grid
};

}  // namespace relief
