// Which way pieces of a surface face.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "renderer/view/view.h"

namespace relief {

/// A box about the normals of some triangles, of any length, in the grid frame of their patch.
struct NormalBounds {
  glm::vec3 low{std::numeric_limits<float>::max()};
  glm::vec3 high{std::numeric_limits<float>::lowest()};

  void add(glm::vec3 normal);
  [[nodiscard]] bool empty() const { return low.x > high.x; }
};

/// Whether a view shows none of a surface's front: the eye lies behind every plane with a normal in
/// the bounds through any point of the sphere about the surface (`centre`, `radius`: world).
/// `axes`: of the patch, not mirrored. Never, if the bounds are empty.
[[nodiscard]] bool faces_away(const View& view, const NormalBounds& normals, const glm::dmat3& axes,
                              glm::dvec3 centre, double radius);

}  // namespace relief
