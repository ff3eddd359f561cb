// The triangles of a mesh, found along rays by Embree.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "common/progress.h"
#include "renderer/engines/raytrace/embree.h"
#include "renderer/triangle_mesh.h"

namespace relief::raytrace {

/// A triangle that a ray meets, and where in single precision: a + u (b - a) + v (c - a).
struct Candidate {
  std::uint32_t triangle = 0;
  float u = 0.0F;
  float v = 0.0F;
};

/// A bounding volume hierarchy over a mesh, for rays from one eye. Embree computes in single
/// precision. Its origin is the place in the mesh's box that is nearest to the eye, and its unit
/// about the box's size, so that neither UTM coordinates, the scan's unit nor a close view matters.
class EmbreeScene {
 public:
  /// Triangles with a corner that is no number are left out. Fails if the memory does not suffice
  /// or the user interrupts.
  static Result<EmbreeScene> build(const TriangleMesh& mesh, glm::dvec3 eye,
                                   const Progress& progress);

  /// The nearest triangle in front of the eye along a direction of any length; of several at the
  /// same distance the mesh's first, however the hierarchy was built.
  [[nodiscard]] std::optional<Candidate> find_nearest(glm::dvec3 direction) const;

  /// All triangles in front of the eye along a direction, in no order. Clears `candidates` first.
  void find_all(glm::dvec3 direction, std::vector<Candidate>& candidates) const;

  /// "Embree 3.13.5"
  [[nodiscard]] std::string name() const;

 private:
  EmbreeScene() = default;
  Status attach(const TriangleMesh& mesh, glm::dvec3 eye);
  [[nodiscard]] std::optional<RTCRayHit> start_ray(glm::dvec3 direction) const;

  DeviceHandle device_;
  SceneHandle scene_;
  Bounds box_;              ///< of the mesh, a little larger; relative to the eye, world units
  glm::dvec3 anchor_{0.0};  ///< Embree's origin, relative to the eye
  double scale_ = 1.0;      ///< Embree's units per world unit, a power of two
};

}  // namespace relief::raytrace
