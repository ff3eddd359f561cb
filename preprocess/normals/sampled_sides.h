// The sides of a whole scan, for parts of it that cannot tell their own.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

#include "common/neighbours/position_tree.h"

namespace relief {

/// Normals of a sample of a scan, for parts of it (orient_sample()).
class SampledSides {
 public:
  /// At least one point, finite, in the frame of the parts. `normals`: unit.
  SampledSides(const std::vector<glm::dvec3>& points, std::vector<glm::vec3> normals)
      : tree_(points), normals_(std::move(normals)) {}

  /// The normal of the nearest sampled point.
  [[nodiscard]] glm::vec3 normal_near(glm::dvec3 position) const;

 private:
  PositionTree tree_;
  std::vector<glm::vec3> normals_;  ///< by index in the tree
};

}  // namespace relief
