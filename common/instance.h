// Transforms and instances of patches.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// A similarity transform: scale, then rotate, then translate. The point p goes to
///   translation + scale * (rotation * p).
struct Transform {
  glm::dvec3 translation{0.0};  ///< world units
  glm::dmat3 rotation{1.0};     ///< orthonormal, right-handed
  double scale = 1.0;           ///< above 0
};

[[nodiscard]] inline glm::dvec3 moved(const Transform& transform, glm::dvec3 p) {
  return transform.translation + transform.scale * (transform.rotation * p);
}

/// One copy, with its own transform, of a run of a model's patches. Several instances may share
/// patches.
struct Instance {
  std::uint32_t first = 0;  ///< in PatchModel::patches
  std::uint32_t count = 0;
  Transform transform;
  std::uint8_t material = 0;  ///< replaces Patch::material
  bool is_closed = false;     ///< replaces PatchModel::is_closed
};

}  // namespace relief
