// The triangles of a mesh as a patch sees them along its normal.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"

namespace relief {

/// How far above or below a patch its texels look for a triangle, cells.
inline constexpr double kTexelReach = 3.0;

/// A triangle over a patch's base plane. Grid frame: columns, rows, cells of height.
struct FlatTriangle {
  std::uint32_t index = 0;              ///< in the mesh
  std::array<glm::dvec2, 3> corners{};  ///< on the base plane
  glm::dvec3 heights{0.0};              ///< at the corners
  double twice_area = 0.0;              ///< below 0: it faces away from the patch's side

  /// Barycentric weights of a place on the base plane; outside some are below 0.
  [[nodiscard]] glm::dvec3 weights_at(glm::dvec2 place) const;
  /// Of the triangle itself.
  [[nodiscard]] double twice_area_in_space() const;
};

/// Spheres about the triangles of a mesh, with which each patch finds its own.
class TriangleSpheres {
 public:
  explicit TriangleSpheres(const Points& mesh);

  /// The triangles over the patch's grid that its normal does not see edge-on, in the mesh's order.
  [[nodiscard]] std::vector<FlatTriangle> find_over(const Patch& patch) const;

 private:
  struct Sphere {
    glm::vec3 centre{0.0F};  ///< from the middle of the mesh
    float radius = 0.0F;
    std::uint32_t triangle = 0;
  };
  /// So that those beside each other are near each other.
  static void sort_by_place(std::vector<Sphere>& spheres, const Bounds& bounds);
  /// So many spheres have one about them.
  static constexpr std::size_t kGroup = 32;
  static std::vector<Sphere> group(const std::vector<Sphere>& spheres);

  const Points& mesh_;
  glm::dvec3 middle_{0.0};
  std::vector<Sphere> spheres_;
  std::vector<Sphere> groups_;  ///< about spheres_
  std::vector<Sphere> blocks_;  ///< about groups_
};

}  // namespace relief
