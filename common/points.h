// A point scan in memory, as the readers give it and the preprocessing uses it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace relief {

using Triangle = std::array<std::uint32_t, 3>;
using CornerTexcoords = std::array<glm::vec2, 3>;  ///< of a triangle's three corners

/// Of a triangle's three corners: x, y, z toward where u grows in the world, any length; w: 1, or
/// -1 where the texture is mirrored; 0: the file gives none.
using CornerTangents = std::array<glm::vec4, 3>;

class MeshTexture;
class NormalTexture;

/// The picture of a texture, undecoded, as a mesh file says it.
struct MeshImage {
  std::string picture;  ///< the texture's file, as the mesh file names it; empty: none
  bool clamps = false;  ///< the texture does not repeat
  /// The texture as a file in memory, of formats that hold their pictures; null: `picture`.
  std::shared_ptr<const std::vector<std::byte>> image_bytes;
};

/// What a mesh file says about the small relief of some of its triangles.
struct MeshNormalMap : MeshImage {
  /// Files that say a larger scale are not believed: all is steeper then than a height field.
  static constexpr double kLargestScale = 1000.0;

  float scale = 1.0F;                            ///< factor on its x and y
  std::shared_ptr<const NormalTexture> texture;  ///< null: smooth
  std::string left_out;  ///< why it is not read, a clause; empty: nothing is left out
};

/// What a mesh file says about the look of some of its triangles: a texture times a colour, and a
/// normal map.
struct MeshMaterial : MeshImage {
  std::string name;                            ///< as the file has it
  glm::vec3 colour{1.0F};                      ///< linear, 0 to 1
  bool has_texcoords = true;                   ///< its triangles have texture coordinates
  bool is_stated = false;                      ///< all is said here, not in a material file
  std::shared_ptr<const MeshTexture> texture;  ///< load_textures reads it; null: the colour alone
  MeshNormalMap normals;
};

/// The material of triangles that have none: they have no colour of their own.
inline constexpr std::uint32_t kNoMaterial = UINT32_MAX;

/// Points with the attributes that their file had. An attribute vector is empty or as long as
/// `positions`. World frame, right-handed, in the file's own unit.
struct Points {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;    ///< any length, possibly zero or NaN as read; unit and outward
                                     ///< after estimate_normals
  std::vector<glm::u8vec3> colours;  ///< 8-bit sRGB
  std::vector<glm::vec2> texcoords;  ///< (u, v), v upward
  std::vector<Triangle> triangles;   ///< indices into `positions`; polygons are split into fans
  /// Empty, or as long as `triangles` where points on the seam of a texture have several texture
  /// coordinates, of which `texcoords` can hold only the first.
  std::vector<CornerTexcoords> corner_texcoords;
  /// Empty, or as long as `triangles` where the file gives tangents.
  std::vector<CornerTangents> corner_tangents;
  std::vector<MeshMaterial> materials;
  std::vector<std::uint32_t> triangle_materials;  ///< empty or as long as `triangles`: indices into
                                                  ///< `materials`, or kNoMaterial
  std::vector<std::string> material_files;        ///< where an OBJ file's materials stand, as it
                                                  ///< names them; until load_textures reads them
  std::optional<glm::dvec3> viewpoint;            ///< where the scanner stood, if the file says so

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// The texture coordinates of a triangle's corners. The points must have texture coordinates.
[[nodiscard]] CornerTexcoords texcoords_of(const Points& mesh, std::size_t triangle);

}  // namespace relief
