#include "preprocess/texture/maps/texture_maps.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <optional>

#include "common/image/srgb.h"
#include "common/mesh/mesh_normals.h"
#include "common/mesh/mesh_tangents.h"
#include "common/mesh/mesh_texture.h"
#include "common/patch_file/continuation.h"
#include "common/patch_file/fast/patch_codec.h"
#include "preprocess/texture/maps/flat_triangles.h"
#include "preprocess/texture/maps/map_scales.h"
#include "preprocess/texture/maps/normal_maps.h"
#include "preprocess/texture/maps/shown_triangles.h"

namespace relief {
namespace {

/// The linear colour of patches without colours.
constexpr float kNeutralGrey = 0.5F;

/// A triangle's colour as a function of the position on the base plane.
class TriangleColour {
 public:
  TriangleColour(const Points& mesh, const FlatTriangle& triangle, double scale) {
    const std::uint32_t material = mesh.triangle_materials[triangle.index];
    if (material == kNoMaterial) return;
    colour_ = mesh.materials[material].colour;
    texture_ = mesh.materials[material].texture.get();
    if (texture_ != nullptr)
      texcoords_.emplace(triangle, texcoords_of(mesh, triangle.index), scale);
  }

  [[nodiscard]] glm::vec3 at(glm::dvec2 position) const {
    if (texture_ == nullptr) return colour_;
    return colour_ * texture_->mean(texcoords_->at(position), texcoords_->du(), texcoords_->dv());
  }

 private:
  glm::vec3 colour_{kNeutralGrey};
  const MeshTexture* texture_ = nullptr;
  std::optional<TexcoordsOverPatch> texcoords_;  ///< with a texture
};

/// The colours that `triangles` show; `shown` is what find_shown makes of them at that scale.
AttributeMap<glm::u8vec3> make_map(const Points& mesh, const Patch& patch,
                                   const std::vector<FlatTriangle>& triangles, std::uint32_t scale,
                                   const std::vector<std::uint32_t>& shown) {
  AttributeMap<glm::u8vec3> map;
  shape_map(patch, scale, map);
  std::fill(map.texels.begin(), map.texels.end(), glm::u8vec3(srgb8_from_linear(kNeutralGrey)));
  std::vector<TriangleColour> colours;
  colours.reserve(triangles.size());
  for (const FlatTriangle& triangle : triangles) colours.emplace_back(mesh, triangle, scale);
  // Only the values that a patch file stores: a reader derives the others in the same manner.
  std::vector<std::uint8_t> kept = kept_texels(patch, scale);
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (shown[k] == kNoTriangle) kept[k] = 0;
    if (kept[k] == 0) continue;
    const std::size_t column = k % map.width;
    const std::size_t row = k / map.width;
    const glm::dvec2 position = glm::dvec2(column, row) / static_cast<double>(scale);
    map.texels[k] = srgb8_from_linear(colours[shown[k]].at(position));
  }
  continue_over_holes(map, kept);
  return map;
}

/// The size of the texture that triangles show.
TextureSize texture_size(const Points& mesh) {
  return [&mesh](std::uint32_t triangle) {
    const std::uint32_t material = mesh.triangle_materials[triangle];
    if (material == kNoMaterial || mesh.materials[material].texture == nullptr)
      return glm::dvec2(0.0);
    const MeshTexture& texture = *mesh.materials[material].texture;
    return glm::dvec2(texture.width(), texture.height());
  };
}

}  // namespace

Status map_textures(const Points& mesh, std::uint32_t texels_per_cell, std::vector<Patch>& patches,
                    Progress& progress) {
  if (patches.empty()) return {};
  progress.begin_stage("textures", patches.size());
  const TriangleSpheres spheres(mesh);
  std::vector<std::vector<FlatTriangle>> triangles(patches.size());
  tbb::parallel_for(std::size_t{0}, patches.size(),
                    [&](std::size_t p) { triangles[p] = spheres.find_over(patches[p]); });
  RELIEF_TRY_ASSIGN(const auto scales,
                    scales_of_maps(mesh, patches, triangles, texture_size(mesh), texels_per_cell));
  std::vector<glm::vec3> normals;
  std::optional<NormalMapper> mapper;
  std::vector<std::uint32_t> normal_scales;
  if (has_normal_maps(mesh)) {
    normals = vertex_normals(mesh);
    mapper.emplace(mesh, normals);
    RELIEF_TRY_ASSIGN(auto chosen, scales_of_maps(mesh, patches, triangles, mapper->image_size(),
                                                  texels_per_cell));
    normal_scales = std::move(chosen);
  }
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    if (progress.cancelled()) return;
    const std::uint32_t scale = scales[p];
    std::vector<std::uint32_t> shown = find_shown(patches[p], scale, triangles[p]);
    patches[p].colours = make_map(mesh, patches[p], triangles[p], scale, shown);
    if (mapper && mapper->has_map(triangles[p])) {
      if (normal_scales[p] != scale) shown = find_shown(patches[p], normal_scales[p], triangles[p]);
      mapper->map(triangles[p], normal_scales[p], shown, patches[p]);
    }
    progress.advance(1);
  });
  if (progress.cancelled()) return interrupted_error();
  return {};
}

}  // namespace relief
