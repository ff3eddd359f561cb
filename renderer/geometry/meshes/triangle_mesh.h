// A mesh as the ray tracer takes it.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <vector>

#include "common/mesh/normal_texture.h"
#include "common/points.h"

namespace relief {

/// A patch's normal map with several texels a cell.
struct PatchNormalMap {
  std::shared_ptr<const NormalTexture> texture;  ///< in the patch's frame, over its whole grid;
                                                 ///< null: the vertices' normals
  glm::mat3 axes{1.0F};                          ///< the patch's, in the world
  float scale = 1.0F;                            ///< texels a cell
};

/// The vertices from `first` on, up to the next one's, are those of one model.
struct MeshBody {
  std::uint32_t first = 0;
  double diameter = 0.0;  ///< of the sphere about it, world units
};

/// Triangles with attributes at their corners. Every vector but `triangles` is empty or as long as
/// `positions`. World frame.
struct TriangleMesh {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< unit, outward; always there; 0: take the triangle's own
  std::vector<glm::vec4>
      colours;                 ///< linear, not premultiplied; alpha: opacity; empty: neutral grey
  std::vector<glm::vec2> uvs;  ///< grid coordinates on the patch; empty for an input mesh
  std::vector<std::uint32_t> patches;   ///< patch id + 1 of each vertex; empty for an input mesh
  std::vector<std::uint8_t> materials;  ///< of each vertex, index into the table of materials
                                        ///< (a triangle has its first's); empty: all 0
  std::vector<Triangle> triangles;
  /// Patches overlap: what is nearer than this behind a surface, along the view axis, is the same
  /// surface. World units; 0 for an input mesh.
  double layer_gap = 0.0;
  /// How much farther along a ray each triangle counts when the nearest is looked for, world units:
  /// those at borders of patches that overlap are behind the whole cells of the next. Empty: none;
  /// else as long as `triangles`.
  std::vector<float> set_backs;
  /// Colours finer than the vertices', which they replace. The first two are empty or as long as
  /// `triangles`, whose textures are indices into `textures`, or kNoMaterial: the vertices'
  /// colours.
  std::vector<CornerTexcoords> texcoords;
  std::vector<std::uint32_t> triangle_textures;
  std::vector<MeshMaterial> textures;
  /// Tangents of the triangles' corners (tangents_of), where textures have normal maps; empty or as
  /// long as `triangles`.
  std::vector<CornerTangents> tangents;
  std::vector<PatchNormalMap> patch_normals;  ///< by patch id; those beyond the last have none
  /// The models of a scene of several, in the order of their vertices; empty: all is one.
  std::vector<MeshBody> bodies;
};

}  // namespace relief
