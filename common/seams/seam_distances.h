// How far points are from the seams between patches.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "common/patch.h"
#include "common/seams/cube_runs.h"
#include "common/seams/seams.h"

namespace relief {

/// The triangles of seams, looked up by position. World frame.
class SeamDistances {
 public:
  SeamDistances(std::span<const Patch> patches, const Seams& seams);

  /// Returns the distance of a point to the nearest triangle; nothing if none is nearer than
  /// `within`, or none is within about two spacings.
  [[nodiscard]] std::optional<double> find(
      glm::dvec3 point, double within = std::numeric_limits<double>::infinity()) const;

 private:
  using Corners = std::array<glm::dvec3, 3>;

  /// What holds a triangle.
  struct Sphere {
    glm::dvec3 middle{0.0};
    double radius = 0.0;
  };

  std::vector<Corners> triangles_;
  CubeRuns cubes_;               ///< of their middles
  std::vector<Sphere> spheres_;  ///< in the order of cubes_
};

}  // namespace relief
