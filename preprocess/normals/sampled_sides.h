// The sides of a whole scan, for parts of it that cannot tell their own.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/bounds.h"
#include "common/neighbours/position_tree.h"
#include "preprocess/normals/winding_numbers.h"

namespace relief {

/// Normals of a sample of a scan, for parts of it (orient_sample()).
class SampledSides {
 public:
  /// At least one point, finite, in the frame of the parts. `normals`: unit. `surface`: pieces of
  /// it about `centre`, with these normals. `number`: the winding number that it should have.
  SampledSides(const std::vector<glm::dvec3>& points, std::vector<glm::vec3> normals,
               PiecedSurface surface, glm::dvec3 centre, float number);

  /// The normal of the nearest sampled point.
  [[nodiscard]] glm::vec3 normal_near(glm::dvec3 position) const;

  /// The winding number that places on the scan should have.
  [[nodiscard]] float number() const { return number_; }

  /// The winding numbers of what lies outside a box about places, which are relative to `centre`.
  [[nodiscard]] Eigen::VectorXf winding_numbers_beyond(const Bounds& box,
                                                       const SurfacePlaces& places,
                                                       glm::dvec3 centre) const;

 private:
  PositionTree tree_;
  std::vector<glm::vec3> normals_;  ///< by index in the tree
  PiecedSurface surface_;
  std::vector<PieceDipole> dipoles_;
  glm::dvec3 centre_;
  float number_;
};

}  // namespace relief
