// The triangles of a mesh, projected along a patch's normal.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "common/cross.h"
#include "common/patch.h"
#include "common/points.h"

namespace relief {

/// Largest distance of a texel's triangle above or below the patch, cells.
inline constexpr double kTexelReach = 3.0;

/// A triangle over a patch's base plane. Grid frame: columns, rows, cells of height.
struct FlatTriangle {
  std::uint32_t index = 0;              ///< in the mesh
  std::array<glm::dvec2, 3> corners{};  ///< on the base plane
  glm::dvec3 heights{0.0};              ///< at the corners
  double twice_area = 0.0;              ///< below 0: faces away from the patch's side

  /// Returns the barycentric weights of a position on the base plane; outside the triangle some are
  /// negative.
  [[nodiscard]] glm::dvec3 weights_at(glm::dvec2 position) const {
    return areas_at(position) / twice_area;
  }
  /// Returns the weights times `twice_area`.
  [[nodiscard]] glm::dvec3 areas_at(glm::dvec2 position) const {
    const glm::dvec2 a = corners[0] - position;
    const glm::dvec2 b = corners[1] - position;
    const glm::dvec2 c = corners[2] - position;
    return {cross(b, c), cross(c, a), cross(a, b)};
  }
  /// Returns the height above a position of the base plane, of the triangle or of its plane.
  [[nodiscard]] double height_at(glm::dvec2 position) const;
  [[nodiscard]] double twice_area_in_space() const;
};

/// Whether triangles are smaller on average than those between points half a cell apart.
[[nodiscard]] bool are_finer_than_grid(const std::vector<FlatTriangle>& triangles);

/// Bounding spheres of a mesh's triangles, with which each patch finds its triangles.
class TriangleSpheres {
 public:
  explicit TriangleSpheres(const Points& mesh);

  /// Returns the triangles over the patch's grid that are not edge-on to its normal, in the mesh's
  /// order.
  [[nodiscard]] std::vector<FlatTriangle> find_over(const Patch& patch) const;

  /// A position of the mesh.
  struct Place {
    std::uint32_t triangle = 0;
    glm::dvec3 position{0.0};
  };
  /// The mesh's position nearest to another one, if it is at most `reach` (world units) from it.
  [[nodiscard]] std::optional<Place> find_nearest(glm::dvec3 position, double reach) const;

 private:
  /// A sphere about triangles, cut by a slab: in a stack, the spheres of all triangles hold the
  /// same places, and only their slabs tell them apart.
  struct Sphere {
    glm::vec3 centre{0.0F};  ///< relative to the centre of the mesh
    float radius = 0.0F;
    glm::vec3 normal{0.0F};  ///< of the slab, which is about the centre; 0: there is none
    float thickness = 0.0F;  ///< on either side
    std::uint32_t triangle = 0;
  };
  /// Sorts spheres so that adjacent ones are near each other.
  static void sort_by_position(std::vector<Sphere>& spheres, const Bounds& bounds);
  /// Gives a group a slab about its members'.
  static void add_slab(std::span<const Sphere> members, Sphere& group);

  /// Number of spheres in a group.
  static constexpr std::size_t kGroup = 32;
  static std::vector<Sphere> group(const std::vector<Sphere>& spheres);
  /// Whether `accepts` any triangle's number, of those whose sphere `may_meet`, as do all about it.
  template <class MayMeet, class Accepts>
  [[nodiscard]] bool any_of_met(const MayMeet& may_meet, const Accepts& accepts) const;

  const Points& mesh_;
  glm::dvec3 middle_{0.0};
  std::vector<Sphere> spheres_;
  std::vector<Sphere> groups_;  ///< about spheres_
  std::vector<Sphere> blocks_;  ///< about groups_
};

}  // namespace relief
