#include "renderer/geometry/meshes/mesh_of_patches.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>

#include "common/mesh/mesh_texture.h"
#include "common/mesh/normal_texture.h"
#include "common/octahedral.h"
#include "common/seams/cell_triangles.h"
#include "common/seams/make_seams.h"
#include "renderer/geometry/meshes/mesh_border.h"
#include "renderer/geometry/meshes/mesh_vertices.h"
#include "renderer/geometry/patch_normals.h"
#include "renderer/geometry/proxy/proxy.h"
#include "renderer/shading/materials.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// The texture coordinates of grid coordinates; those of a node are its texel's middle.
glm::vec2 texcoord_of(const AttributeMap<glm::u8vec3>& map, glm::dvec2 uv) {
  const glm::dvec2 texel = uv * static_cast<double>(map.scale) + 0.5;
  return {texel / glm::dvec2(map.width, map.height)};
}

/// A colour map with several texels a cell becomes a texture of the triangles from `first` on.
void add_texture(const Patch& patch, std::size_t first, TriangleMesh& mesh) {
  if (patch.colours.scale < 2 || patch.colours.empty()) return;
  const AttributeMap<glm::u8vec3>& map = patch.colours;
  std::vector<glm::u8vec3> upward;  // textures have their top row first
  upward.reserve(map.texels.size());
  for (std::size_t row = map.height; row-- > 0;) {
    const auto begin = map.texels.begin() + static_cast<std::ptrdiff_t>(row * map.width);
    upward.insert(upward.end(), begin, begin + map.width);
  }
  MeshMaterial texture;
  texture.texture = std::make_shared<const MeshTexture>(map.width, map.height, std::move(upward),
                                                        TextureWrap::Clamp);
  mesh.triangle_textures.resize(first, kNoMaterial);
  mesh.triangle_textures.resize(mesh.triangles.size(),
                                static_cast<std::uint32_t>(mesh.textures.size()));
  mesh.textures.push_back(std::move(texture));
  mesh.texcoords.resize(first);
  for (std::size_t t = first; t < mesh.triangles.size(); ++t) {
    CornerTexcoords corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      corners[c] = texcoord_of(map, mesh.uvs[mesh.triangles[t][c]]);
    }
    mesh.texcoords.push_back(corners);
  }
}

/// A normal map with several texels a cell.
PatchNormalMap normal_map_over(const Patch& patch) {
  if (patch.normals.scale < 2 || patch.normals.empty()) return {};
  const AttributeMap<glm::i16vec2>& map = patch.normals;
  std::vector<glm::i16vec3> upward;  // textures have their top row first
  upward.reserve(map.texels.size());
  for (std::size_t row = map.height; row-- > 0;) {
    for (std::size_t column = 0; column < map.width; ++column) {
      const glm::vec3 normal = unit_from_snorm16(map.texels[row * map.width + column]);
      upward.push_back(NormalTexture::texel_of(normal));
    }
  }
  return {std::make_shared<const NormalTexture>(map.width, map.height, std::move(upward),
                                                TextureWrap::Clamp),
          glm::mat3(patch.axes), static_cast<float>(map.scale)};
}

/// Adds the cells of a patch: whole ones alone, or also half of those of three samples.
void add_triangles(const Patch& patch, const std::vector<std::uint32_t>& vertices, bool whole,
                   TriangleMesh& mesh) {
  const double largest_rise = shared::kSteepest * patch.spacing / patch.height_step;
  const auto joined = [&](std::size_t a, std::size_t b) {
    return vertices[a] != kNoVertex && vertices[b] != kNoVertex &&
           std::abs(patch.heights[b] - patch.heights[a]) <= largest_rise;
  };
  for (std::size_t j = 0; j + 1 < patch.height; ++j) {
    for (std::size_t i = 0; i + 1 < patch.width; ++i) {
      const std::size_t node = j * patch.width + i;
      const std::size_t above = node + patch.width;
      if (whole && (vertices[node + 1] == kNoVertex || vertices[above] == kNoVertex)) continue;
      if (joined(node, node + 1) && joined(node + 1, above + 1))
        mesh.triangles.push_back({vertices[node], vertices[node + 1], vertices[above + 1]});
      if (joined(node, above) && joined(above, above + 1))
        mesh.triangles.push_back({vertices[node], vertices[above + 1], vertices[above]});
    }
  }
}

/// Adds the whole cells of a patch that meets others, and its part of the seams. Returns each seam
/// vertex that it has, by its corner in `triangles`, and which vertex that has become.
std::unordered_map<std::uint32_t, std::uint32_t> add_joined_triangles(
    const Patch& patch, std::uint32_t id, const Seams& seams, std::span<const Triangle> triangles,
    bool coloured, const std::vector<std::uint32_t>& vertices, TriangleMesh& mesh) {
  const CellTriangles cells = cell_triangles(patch);
  for (std::uint32_t j = 0; j < cells.rows; ++j) {
    for (std::uint32_t i = 0; i < cells.columns; ++i) {
      if (cells.at(i, j) != kWholeCell) continue;
      for_each_triangle(patch, cells, i, j, [&](const Triangle& t) {
        mesh.triangles.push_back({vertices[t[0]], vertices[t[1]], vertices[t[2]]});
      });
    }
  }
  const AttributeMap<glm::i16vec2> normals = normal_map_of(patch);
  std::unordered_map<std::uint32_t, std::uint32_t> added;
  const auto vertex_of = [&](std::uint32_t corner) {
    if ((corner & kSeamVertexBit) == 0) return vertices[corner];
    const auto [found, is_new] = added.try_emplace(corner, 0);
    if (!is_new) return found->second;
    const glm::dvec3 position = seams.vertices[corner & ~kSeamVertexBit].position;
    const glm::dvec2 uv =
        glm::dvec2(glm::transpose(patch.axes) * (position - patch.origin)) / patch.spacing;
    found->second = add_vertex_between(patch, id, normals, position, uv, coloured, mesh);
    return found->second;
  };
  for (const Triangle& t : triangles)
    mesh.triangles.push_back({vertex_of(t[0]), vertex_of(t[1]), vertex_of(t[2])});
  return added;
}

}  // namespace

Result<TriangleMesh> mesh_of_patches(const PatchModel& model, MeshBorder border,
                                     std::vector<SeamCopy>* copies) {
  const std::size_t samples = count_samples(model);
  if (samples >= kNoVertex) {
    return make_error(
        "the model has {} samples, but rays are traced through at most {}; convert "
        "again with a larger spacing",
        samples, kNoVertex - 1);
  }
  TriangleMesh mesh;
  mesh.positions.reserve(samples);
  mesh.normals.reserve(samples);
  mesh.uvs.reserve(samples);
  mesh.patches.reserve(samples);
  if (model.has_colours) mesh.colours.reserve(samples);
  mesh.triangles.reserve(2 * samples);
  Seams seams;
  std::uint32_t first_seam = 0;  // of the run
  for (std::uint32_t p = 0; p < model.patches.size(); ++p) {
    mesh.layer_gap = std::max(mesh.layer_gap, double{shared::kLayerGap} * model.patches[p].spacing);
    const Patch& patch = model.patches[p];
    const std::size_t first = mesh.triangles.size();
    const std::vector<std::uint32_t> vertices = add_vertices(patch, p, model.has_colours, mesh);
    if (const PatchRun* const run = run_of(model, p)) {
      if (p == run->first) {
        first_seam += static_cast<std::uint32_t>(seams.vertices.size());
        seams = make_seams(std::span(model.patches).subspan(p, run->count), run->is_closed);
      }
      const auto added = add_joined_triangles(patch, p, seams, seams.triangles[p - run->first],
                                              model.has_colours, vertices, mesh);
      if (copies != nullptr) {
        for (const auto& [corner, vertex] : added)
          copies->push_back({vertex, first_seam + (corner & ~kSeamVertexBit)});
      }
    } else {
      const bool curve = border == MeshBorder::Curve;
      add_triangles(patch, vertices, curve, mesh);
      if (curve) add_border(patch, p, model.has_colours, vertices, mesh);
    }
    add_texture(patch, first, mesh);
    if (PatchNormalMap map = normal_map_over(patch); map.texture != nullptr) {
      mesh.patch_normals.resize(p);
      mesh.patch_normals.push_back(std::move(map));
    }
  }
  if (!mesh.triangle_textures.empty()) {
    mesh.triangle_textures.resize(mesh.triangles.size(), kNoMaterial);
    mesh.texcoords.resize(mesh.triangles.size());
  }
  if (!mesh.set_backs.empty()) mesh.set_backs.resize(mesh.triangles.size(), 0.0F);
  mesh.materials = materials_of_patches(model, mesh.patches);
  return mesh;
}

std::vector<MeshBody> bodies_of(const PatchModel& model, const TriangleMesh& mesh) {
  std::vector<MeshBody> bodies;
  std::uint32_t patches = 0;
  for (const Instance& instance : model.instances) {
    const auto run = std::span(model.patches).subspan(instance.first, instance.count);
    const auto first = std::lower_bound(mesh.patches.begin(), mesh.patches.end(), patches + 1);
    bodies.push_back({static_cast<std::uint32_t>(first - mesh.patches.begin()),
                      2.0 * instance.transform.scale * sphere_about(run).radius});
    patches += instance.count;
  }
  return bodies;
}

}  // namespace relief
