#include "preprocess/texture/maps/normal_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <utility>

#include "common/mesh/mesh_tangents.h"
#include "common/mesh/normal_texture.h"
#include "common/octahedral.h"
#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "preprocess/texture/maps/shown_triangles.h"

namespace relief {
namespace {

/// A triangle's normals as a function of the position on the base plane.
class TriangleNormals {
 public:
  TriangleNormals(const Points& mesh, const std::vector<glm::vec3>& normals,
                  const std::vector<CornerTangents>& tangents, const FlatTriangle& triangle,
                  double scale)
      : triangle_(&triangle),
        map_(triangle_normal_map(mesh, triangle.index)),
        tangents_(tangents[triangle.index]) {
    for (std::size_t c = 0; c < 3; ++c) normals_[c] = normals[mesh.triangles[triangle.index][c]];
    if (map_ != nullptr) texcoords_.emplace(triangle, texcoords_of(mesh, triangle.index), scale);
  }

  /// World, unit; 0 where there is none.
  [[nodiscard]] glm::dvec3 at(glm::dvec2 position) const {
    const TangentFrame frame = frame_at(tangents_, normals_, triangle_->weights_at(position));
    if (map_ == nullptr) return perturbed_normal(frame, {0.0F, 0.0F, 1.0F}, 1.0F);
    return perturbed_normal(
        frame, map_->texture->mean(texcoords_->at(position), texcoords_->du(), texcoords_->dv()),
        map_->scale);
  }

 private:
  const FlatTriangle* triangle_;
  const MeshNormalMap* map_;
  CornerTangents tangents_;
  std::array<glm::vec3, 3> normals_{};
  std::optional<TexcoordsOverPatch> texcoords_;  ///< with a map
};

}  // namespace

NormalMapper::NormalMapper(const Points& mesh, const std::vector<glm::vec3>& normals)
    : mesh_(mesh), normals_(normals), tangents_(tangents_of(mesh, normals)) {}

TextureSize NormalMapper::image_size() const {
  return [this](std::uint32_t triangle) {
    const MeshNormalMap* const map = triangle_normal_map(mesh_, triangle);
    return map == nullptr ? glm::dvec2(0.0)
                          : glm::dvec2(map->texture->width(), map->texture->height());
  };
}

bool NormalMapper::has_map(const std::vector<FlatTriangle>& triangles) const {
  return std::any_of(triangles.begin(), triangles.end(), [this](const FlatTriangle& triangle) {
    return triangle_normal_map(mesh_, triangle.index) != nullptr;
  });
}

void NormalMapper::map(const std::vector<FlatTriangle>& triangles, std::uint32_t scale,
                       const std::vector<std::uint32_t>& shown, Patch& patch) const {
  AttributeMap<glm::i16vec2> fine;
  shape_map(patch, scale, fine);
  std::vector<TriangleNormals> normals;
  normals.reserve(triangles.size());
  for (const FlatTriangle& triangle : triangles)
    normals.emplace_back(mesh_, normals_, tangents_, triangle, scale);
  const glm::dmat3 to_patch = glm::transpose(patch.axes);
  std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (kept[k] == 0) continue;
    const glm::dvec2 position =
        glm::dvec2(k % fine.width, k / fine.width) / static_cast<double>(scale);
    glm::dvec3 normal(0.0);
    if (shown[k] != kNoTriangle && triangles[shown[k]].twice_area > 0.0)
      normal = to_patch * normals[shown[k]].at(position);
    kept[k] = normal == glm::dvec3(0.0) ? 0 : 1;
    if (kept[k] != 0) fine.texels[k] = snorm16_from_unit(glm::vec3(normal));
  }
  if (std::find(kept.begin(), kept.end(), 1) == kept.end()) return;
  continue_over_holes(fine, kept);
  patch.normals = std::move(fine);
}

}  // namespace relief
