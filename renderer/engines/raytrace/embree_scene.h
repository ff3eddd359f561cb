// The triangles of a mesh, found along rays by Embree.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"
#include "common/progress.h"
#include "renderer/engines/raytrace/embree.h"
#include "renderer/engines/raytrace/meet_triangle.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief::raytrace {

/// A ray: from `start`, world units from the eye, along `direction`.
struct SightRay {
  glm::dvec3 start{0.0};
  glm::dvec3 direction{0.0};
};

/// Where the rays of a scene begin: all at the eye, or each at a position of its own.
enum class RayStarts : std::uint8_t { AtEye, Anywhere };

/// A mesh for rays from one eye, or about one. Embree's hierarchy of boxes finds the triangles that
/// a ray may meet; whether it does is decided here, in double precision and without a slit: a ray
/// through an edge or a vertex meets all triangles around it. Embree's own test lets 1 % of the
/// rays through that aim at a vertex.
///
/// The boxes are in single precision, with the position of the mesh's box that is nearest to the
/// eye as origin and about the mesh's size as unit, so that neither UTM coordinates nor a scan's
/// unit matters.
class EmbreeScene {
 public:
  /// The mesh must outlive it. Triangles with a corner that is NaN are left out. Fails if the
  /// memory does not suffice or the user interrupts.
  static Result<EmbreeScene> build(const TriangleMesh& mesh, glm::dvec3 eye,
                                   const Progress& progress, RayStarts starts = RayStarts::AtEye);

  /// The nearest triangle ahead of a ray's start, as TriangleMesh::set_backs counts; of several at
  /// the same depth the mesh's first, however the hierarchy was built. The start is 0 unless the
  /// scene was built for others.
  [[nodiscard]] std::optional<Hit> find_nearest(const SightRay& ray) const;

  /// The nearest triangle ahead that the ray meets from its normals' other side, as one within a
  /// body does. The triangle that it starts on is none of them if it goes inward, however rounding
  /// turns out, nor is a patch that overlaps it.
  [[nodiscard]] std::optional<Hit> find_leaving(const SightRay& ray) const;

  /// All triangles ahead of it, in no order. Clears `hits` first.
  void find_all(const SightRay& ray, std::vector<Hit>& hits) const;

  /// "Embree 3.13.5"
  [[nodiscard]] std::string name() const;

 private:
  struct Corners;
  struct Query;
  EmbreeScene() = default;
  void attach();
  void follow(Query& query) const;
  [[nodiscard]] std::optional<Hit> find_first(const SightRay& ray, bool leaving) const;
  static void bound(const RTCBoundsFunctionArguments* asked);
  static void meet(const RTCIntersectFunctionNArguments* asked);

  std::shared_ptr<Corners> corners_;  ///< what Embree asks about, at a position that does not move
  DeviceHandle device_;
  SceneHandle scene_;
  Bounds box_;  ///< of the mesh, a little larger; relative to the eye, in Embree's unit
};

}  // namespace relief::raytrace
