#include "preprocess/mesh_fit/overhang_normals.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>

#include "common/octahedral.h"
#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "preprocess/texture/maps/shown_triangles.h"

namespace relief {
namespace {

// Samples farther off are strays (drop_stray_samples).
constexpr double kReachInSpacings = 0.4;
// The cosine to the patch's normal from which on a normal is of the patch's side.
constexpr double kFacing = 0.1;

/// The normal at a position of the mesh: world; 0 for slivers and where normals cancel out.
glm::dvec3 normal_at(const Points& mesh, const std::vector<glm::vec3>& normals,
                     const TriangleSpheres::Place& place) {
  const Triangle& corners = mesh.triangles[place.triangle];
  glm::dvec3 sum(0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    const glm::dvec3 a = mesh.positions[corners[(c + 1) % 3]] - place.position;
    const glm::dvec3 b = mesh.positions[corners[(c + 2) % 3]] - place.position;
    sum += glm::length(glm::cross(a, b)) * glm::dvec3(normals[corners[c]]);
  }
  const double length = glm::length(sum);
  return length > 0.0 ? sum / length : glm::dvec3(0.0);
}

}  // namespace

void take_nearest_normals(const Points& mesh, const std::vector<glm::vec3>& normals,
                          const std::vector<FlatTriangle>& triangles,
                          std::span<const std::uint32_t> shown, const TriangleSpheres& spheres,
                          Patch& patch) {
  const glm::dmat3 to_patch = glm::transpose(patch.axes);
  bool changed = false;
  for (std::uint32_t k = 0; k < shown.size(); ++k) {
    if (patch.heights[k] == kHole) continue;
    if (shown[k] != kNoTriangle && triangles[shown[k]].twice_area > 0.0) continue;
    const std::optional<TriangleSpheres::Place> place = spheres.find_nearest(
        position_of(patch, k % patch.width, k / patch.width), kReachInSpacings * patch.spacing);
    if (!place) continue;
    const glm::dvec3 normal = to_patch * normal_at(mesh, normals, *place);
    if (normal.z < kFacing) continue;
    patch.normals.texels[k] = snorm16_from_unit(glm::vec3(normal));
    changed = true;
  }
  if (changed) continue_over_holes(patch.normals, sample_mask(patch));
}

}  // namespace relief
