// Normal maps of patches from those of the mesh that they were made of.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/patch.h"
#include "common/points.h"
#include "preprocess/texture/maps/flat_triangles.h"
#include "preprocess/texture/maps/map_scales.h"

namespace relief {

/// Gives patches the normal maps of a mesh, perturbed smooth normals of it, at a resolution of
/// their own. Threads may share one.
class NormalMapper {
 public:
  /// `normals`: of the mesh's points (vertex_normals). Both must outlive it.
  NormalMapper(const Points& mesh, const std::vector<glm::vec3>& normals);

  /// The size of the normal map that a triangle has.
  [[nodiscard]] PictureSize picture_size() const;

  /// Whether one of a patch's triangles has a normal map. If not, its normals can stay as they are.
  [[nodiscard]] bool has_map(const std::vector<FlatTriangle>& triangles) const;

  /// Replaces a patch's normals by a map of `scale` texels a cell. A texel has the normal of the
  /// triangle that it shows (`shown`, which find_shown made of `triangles`, those over the patch,
  /// at that scale): the mean of the normal map over the texel in the triangle's tangent frame, or
  /// without a normal map the smooth one. Texels over holes, and those that meet no triangle that
  /// faces the patch's side, continue their surroundings.
  void map(const std::vector<FlatTriangle>& triangles, std::uint32_t scale,
           const std::vector<std::uint32_t>& shown, Patch& patch) const;

 private:
  const Points& mesh_;
  const std::vector<glm::vec3>& normals_;
  std::vector<CornerTangents> tangents_;  ///< of its triangles
};

}  // namespace relief
