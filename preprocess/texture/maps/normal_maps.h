// Makes the normal maps of patches from those of their mesh.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"
#include "preprocess/texture/maps/map_scales.h"

namespace relief {

/// Gives patches a mesh's perturbed normals as maps, each with its own resolution. Threads may
/// share an object.
class NormalMapper {
 public:
  /// `normals` of the mesh's points (vertex_normals). Mesh and normals must outlive this object.
  NormalMapper(const Points& mesh, const std::vector<glm::vec3>& normals);

  /// Returns the size of a triangle's normal map.
  [[nodiscard]] TextureSize image_size() const;

  /// Returns whether one of a patch's triangles has a normal map. If not, its normals stay
  /// unchanged.
  [[nodiscard]] bool has_map(const std::vector<FlatTriangle>& triangles) const;

  /// Replaces a patch's normals by a map of `scale` texels a cell. A texel gets the normal of the
  /// triangle that it shows: the mean of the normal map over the texel, in the triangle's tangent
  /// frame, or the smooth normal without a normal map. `triangles`: those over the patch. `shown`:
  /// their find_shown at that scale. Texels over holes, and those without a triangle that faces the
  /// patch's side, continue their surroundings.
  void map(const std::vector<FlatTriangle>& triangles, std::uint32_t scale,
           const std::vector<std::uint32_t>& shown, Patch& patch) const;

 private:
  const Points& mesh_;
  const std::vector<glm::vec3>& normals_;
  std::vector<CornerTangents> tangents_;  ///< of its triangles
};

}  // namespace relief
