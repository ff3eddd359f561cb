// The glTF reader: from a parsed file, which is not trusted, to points.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <string>
#include <utility>

#include "common/image/srgb.h"
#include "preprocess/readers/gltf/gltf_accessor.h"
#include "preprocess/readers/gltf/gltf_nodes.h"
#include "preprocess/readers/gltf/gltf_parse.h"
#include "preprocess/readers/gltf/gltf_tangents.h"
#include "preprocess/readers/gltf/gltf_textures.h"
#include "preprocess/readers/polygons.h"
#include "preprocess/readers/readers.h"

namespace relief {
namespace {

/// Limits the points of nodes that repeat one mesh; real files have far fewer.
constexpr std::size_t kMaxPoints = 200'000'000;

class GltfReader {
 public:
  GltfReader(const Source& source, tinygltf::Model model)
      : source_(source), model_(std::move(model)) {}

  Result<Points> read() {
    if (!model_.extensionsRequired.empty()) {
      return make_error("{}: needs the extension {}, which is not read; export it without",
                        source_.name, relief::quoted(model_.extensionsRequired.front()));
    }
    if (Status done = read_materials(); !done) return wrong(done);
    if (Status done = read_scene(); !done) return wrong(done);
    if (points_.size() >= kNoPoint) return too_many_points(source_, points_.size());
    if (!has_normals_) points_.normals.clear();
    choose_colours();
    if (!has_texcoords_) points_.texcoords.clear();
    if (!tangents_.empty()) points_.corner_tangents = by_corner(tangents_, points_.triangles);
    points_.stance = Stance{};  // the format says that Y is up and Z in front
    return std::move(points_);
  }

 private:
  Error wrong(const Status& why) const {
    return make_error("{}: {}", source_.name, why.error().message);
  }

  /// Makes two materials for each of the file's: with texture coordinates and without.
  Status read_materials() {
    for (const tinygltf::Material& given : model_.materials) {
      MeshMaterial material;
      material.name = given.name;
      material.is_stated = true;
      const auto& base = given.pbrMetallicRoughness;
      for (std::size_t c = 0; c < 3 && c < base.baseColorFactor.size(); ++c) {
        const double v = base.baseColorFactor[c];
        material.colour[static_cast<glm::length_t>(c)] =
            v > 0.0 ? static_cast<float>(std::min(v, 1.0)) : 0.0F;
      }
      if (base.baseColorTexture.index >= 0) {
        RELIEF_TRY_ASSIGN(auto texture, textures_.read(base.baseColorTexture.index));
        static_cast<MeshImage&>(material) = std::move(texture);
      }
      RELIEF_TRY_ASSIGN(auto normals,
                        textures_.read_normals(given.normalTexture, texcoord_set_of(given)));
      material.normals = std::move(normals);
      points_.materials.push_back(material);
      material.has_texcoords = false;
      points_.materials.push_back(std::move(material));
    }
    return {};
  }

  Status read_scene() {
    RELIEF_TRY_ASSIGN(const auto meshes, mesh_instances(model_));
    for (const MeshInstance& mesh : meshes) {
      RELIEF_TRY(read_mesh(mesh.mesh, mesh.to_world));
    }
    return {};
  }

  Status read_mesh(int index, const glm::dmat4& to_world) {
    if (static_cast<std::size_t>(index) >= model_.meshes.size())
      return make_error("there is no mesh {}", index);
    if (source_.progress.cancelled()) return interrupted_error();
    for (const tinygltf::Primitive& primitive :
         model_.meshes[static_cast<std::size_t>(index)].primitives) {
      if (Status done = read_primitive(primitive, to_world); !done)
        return make_error("mesh {}: {}", index, done.error().message);
    }
    return {};
  }

  Status read_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& to_world) {
    const auto attribute = [&primitive](const std::string& name) {
      const auto found = primitive.attributes.find(name);
      return found == primitive.attributes.end() ? -1 : found->second;
    };
    RELIEF_TRY_ASSIGN(const auto positions, read_accessor(model_, attribute("POSITION"), 3));
    const std::size_t first = points_.size();
    const std::size_t count = positions.size() / 3;
    if (first + count > kMaxPoints)
      return make_error("its nodes show more than {} points together", kMaxPoints);
    for (std::size_t k = 0; k < count; ++k) {
      const double* p = positions.data() + 3 * k;
      points_.positions.emplace_back(to_world * glm::dvec4(p[0], p[1], p[2], 1.0));
    }
    RELIEF_TRY(read_normals(attribute("NORMAL"), count, to_world));
    RELIEF_TRY(read_colours(attribute("COLOR_0"), count));
    const bool is_material = primitive.material >= 0 &&
                             static_cast<std::size_t>(primitive.material) < model_.materials.size();
    std::string name = "TEXCOORD_0";
    if (is_material) {
      const auto& material = model_.materials[static_cast<std::size_t>(primitive.material)];
      name = fmt::format("TEXCOORD_{}", texcoord_set_of(material));
    }
    const int texcoords = attribute(name);
    RELIEF_TRY(read_texcoords(texcoords, count));
    RELIEF_TRY(keep_tangents(attribute("TANGENT"), count, to_world));
    const std::uint32_t material =
        is_material ? 2 * static_cast<std::uint32_t>(primitive.material) + (texcoords < 0 ? 1U : 0U)
                    : kNoMaterial;
    return read_triangles(primitive, first, count, material, glm::determinant(to_world) < 0.0);
  }

  Status read_normals(int accessor, std::size_t count, const glm::dmat4& to_world) {
    points_.normals.resize(points_.size(), glm::vec3(0.0F));
    if (accessor < 0) return {};
    RELIEF_TRY_ASSIGN(const auto normals, read_accessor(model_, accessor, 3));
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(to_world)));
    for (std::size_t k = 0; k < std::min(count, normals.size() / 3); ++k) {
      const double* n = normals.data() + 3 * k;
      points_.normals[points_.size() - count + k] = turn * glm::dvec3(n[0], n[1], n[2]);
    }
    has_normals_ = true;
    return {};
  }

  /// Reads vertex colours, linear and possibly with alpha. They are used if all vertices have them.
  Status read_colours(int index, std::size_t count) {
    if (index < 0 || static_cast<std::size_t>(index) >= model_.accessors.size()) return {};
    const int type = model_.accessors[static_cast<std::size_t>(index)].type;
    const std::size_t components = type == TINYGLTF_TYPE_VEC4 ? 4 : 3;
    RELIEF_TRY_ASSIGN(const auto colours,
                      read_accessor(model_, index, static_cast<int>(components)));
    for (std::size_t k = 0; k < std::min(count, colours.size() / components); ++k) {
      const double* c = colours.data() + components * k;
      points_.colours.push_back(srgb8_from_linear(glm::vec3(c[0], c[1], c[2])));
    }
    return {};
  }

  /// Vertex colours multiply those of materials. They are used only if all materials are white, as
  /// exporters of coloured points write them.
  void choose_colours() {
    const bool all_white = std::ranges::all_of(points_.materials, [](const MeshMaterial& m) {
      return m.colour == glm::vec3(1.0F) && m.image.empty() && m.image_bytes == nullptr &&
             m.normals.image.empty() && m.normals.image_bytes == nullptr;
    });
    if (points_.colours.size() != points_.size() || !all_white) {
      points_.colours.clear();
    } else {
      points_.materials.clear();
      points_.triangle_materials.clear();
    }
  }

  /// In glTF, v points downward.
  Status read_texcoords(int accessor, std::size_t count) {
    points_.texcoords.resize(points_.size(), glm::vec2(0.0F));
    if (accessor < 0) return {};
    RELIEF_TRY_ASSIGN(const auto texcoords, read_accessor(model_, accessor, 2));
    for (std::size_t k = 0; k < std::min(count, texcoords.size() / 2); ++k)
      points_.texcoords[points_.size() - count + k] = {texcoords[2 * k],
                                                       1.0 - texcoords[2 * k + 1]};
    has_texcoords_ = true;
    return {};
  }

  Status keep_tangents(int accessor, std::size_t count, const glm::dmat4& to_world) {
    if (accessor < 0) return {};
    RELIEF_TRY_ASSIGN(auto tangents, read_tangents(model_, accessor, count, to_world));
    tangents_.resize(points_.size() - count, glm::vec4(0.0F));
    tangents_.insert(tangents_.end(), tangents.begin(), tangents.end());
    return {};
  }

  Status read_triangles(const tinygltf::Primitive& primitive, std::size_t first, std::size_t count,
                        std::uint32_t material, bool mirrored) {
    std::vector<std::uint32_t> corners;
    if (primitive.indices >= 0) {
      RELIEF_TRY_ASSIGN(const auto indices, read_accessor(model_, primitive.indices, 1));
      for (const double index : indices) {
        // clean_points drops triangles with invalid indices.
        const bool exists = index >= 0.0 && index < static_cast<double>(count);
        corners.push_back(exists
                              ? static_cast<std::uint32_t>(first + static_cast<std::size_t>(index))
                              : kNoPoint - 1);
      }
    } else {
      for (std::size_t k = 0; k < count; ++k)
        corners.push_back(static_cast<std::uint32_t>(first + k));
    }
    const std::size_t before = points_.triangles.size();
    if (primitive.mode == TINYGLTF_MODE_TRIANGLES || primitive.mode == -1) {
      for (std::size_t k = 0; k + 2 < corners.size(); k += 3)
        points_.triangles.push_back({corners[k], corners[k + 1], corners[k + 2]});
    } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      append_strips(corners, points_.triangles);
    } else if (primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN) {
      append_polygon(corners, points_.triangles);
    }
    for (std::size_t t = before; mirrored && t < points_.triangles.size(); ++t)
      std::swap(points_.triangles[t][1], points_.triangles[t][2]);
    if (!points_.materials.empty())
      points_.triangle_materials.resize(points_.triangles.size(), material);
    return {};
  }

  const Source& source_;
  tinygltf::Model model_;
  Points points_;
  GltfTextures textures_{model_};
  std::vector<glm::vec4> tangents_;  ///< by point, up to the last that has one
  bool has_normals_ = false;
  bool has_texcoords_ = false;
};

}  // namespace

Result<Points> read_gltf(const Source& source) {
  RELIEF_TRY_ASSIGN(auto model, parse_gltf(source));
  return GltfReader(source, std::move(model)).read();
}

}  // namespace relief
