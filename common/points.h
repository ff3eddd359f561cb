// A point scan or mesh in memory, from the readers to preprocessing.
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

#include "common/scalar.h"
#include "common/stance.h"

namespace relief {

using Triangle = std::array<std::uint32_t, 3>;
using CornerTexcoords = std::array<glm::vec2, 3>;  ///< one a corner of a triangle

/// Tangents of a triangle's three corners. x, y, z: world direction in which u grows, any length.
/// w: 1, or -1 if the texture is mirrored, or 0 if the file gives no tangent.
using CornerTangents = std::array<glm::vec4, 3>;

class MeshTexture;
class NormalTexture;

/// The undecoded image of a texture, as a mesh file gives it.
struct MeshImage {
  std::string image;    ///< the image's file, as the mesh file names it; empty: no texture
  bool clamps = false;  ///< the texture does not repeat
  /// The image file's bytes, for formats that embed images; null: read `image`.
  std::shared_ptr<const std::vector<std::byte>> image_bytes;
};

/// A normal map of a mesh file.
struct MeshNormalMap : MeshImage {
  /// Larger scales are ignored: they would be steeper than any height field.
  static constexpr double kLargestScale = 1000.0;

  float scale = 1.0F;                            ///< factor of x and y of its normals
  std::shared_ptr<const NormalTexture> texture;  ///< null: none
  std::string left_out;  ///< why the map is not read, a clause; empty: it is read
};

/// A material of a mesh file: a texture times a colour, and a normal map.
struct MeshMaterial : MeshImage {
  std::string name;                            ///< as in the file
  glm::vec3 colour{1.0F};                      ///< linear, 0 to 1
  bool has_texcoords = true;                   ///< its triangles have texture coordinates
  bool is_stated = false;                      ///< complete without a material file
  std::shared_ptr<const MeshTexture> texture;  ///< read by load_textures; null: only the colour
  MeshNormalMap normals;
};

/// The index that stands for "no material": these triangles have no colour of their own.
inline constexpr std::uint32_t kNoMaterial = UINT32_MAX;

/// Points with their file's attributes. An attribute vector is empty or as long as `positions`.
/// World frame, right-handed, in the file's own unit.
struct Points {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;    ///< any length, possibly zero or NaN as read; unit and outward
                                     ///< after estimate_normals
  std::vector<glm::u8vec3> colours;  ///< 8-bit sRGB
  std::vector<glm::vec2> texcoords;  ///< (u, v), v upward
  std::vector<Triangle> triangles;   ///< indices into `positions`; polygons are split into fans
  /// Empty, or as long as `triangles`: for points on texture seams, which have several texture
  /// coordinates. `texcoords` holds only the first.
  std::vector<CornerTexcoords> corner_texcoords;
  /// Empty, or as long as `triangles` if the file gives tangents.
  std::vector<CornerTangents> corner_tangents;
  std::vector<MeshMaterial> materials;
  std::vector<std::uint32_t> triangle_materials;  ///< empty or as long as `triangles`: indices into
                                                  ///< `materials`, or kNoMaterial
  std::vector<std::string> material_files;  ///< material files that an OBJ file names; empty once
                                            ///< load_textures has read them
  std::vector<PointScalar> scalars;         ///< those that were asked for
  std::optional<glm::dvec3> viewpoint;      ///< the scanner's position, if the file gives it
  std::optional<Stance> stance;             ///< if known, from the file or a mesh's shape
  /// The scanners' positions, if the file gives several; empty otherwise.
  std::vector<glm::dvec3> scanners;
  std::vector<std::uint16_t> scanner_of;  ///< index into `scanners`; empty if there are none
  bool is_airborne = false;               ///< scanned from above, as far as the file tells

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// Returns how points stand: as their file says, otherwise as is usual: Y up for a mesh, Z up for
/// bare points, as in surveys.
[[nodiscard]] Stance stance_of(const Points& points);

/// Appends a point that is equal to another one, with all that is known of it.
void repeat_point(Points& points, std::uint32_t index);

/// Returns the texture coordinates of a triangle's corners. The points must have them.
[[nodiscard]] CornerTexcoords texcoords_of(const Points& mesh, std::size_t triangle);

}  // namespace relief
