// glTF 2.0, parsed by tinygltf; what it gives is not trusted.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <glm/gtc/quaternion.hpp>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <memory>
#include <string>
#include <utility>

#include "common/guard.h"
#include "common/image/srgb.h"
#include "common/io/file.h"
#include "preprocess/readers/gltf/gltf_accessor.h"
#include "preprocess/readers/gltf/gltf_tangents.h"
#include "preprocess/readers/gltf/gltf_textures.h"
#include "preprocess/readers/polygons.h"
#include "preprocess/readers/readers.h"
#include "preprocess/texture/files/load_textures.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// tinygltf's parser calls itself for what nests in JSON.
constexpr int kMaxDepth = 64;
/// Nodes may show one mesh again and again; nothing real comes near.
constexpr std::size_t kMaxPoints = 200'000'000;

bool nests_too_deep(std::string_view json) {
  int depth = 0;
  bool in_text = false;
  for (std::size_t k = 0; k < json.size(); ++k) {
    const char c = json[k];
    if (in_text) {
      if (c == '\\') ++k;
      in_text = c != '"';
    } else if (c == '"') {
      in_text = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kMaxDepth) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

/// Keeps a picture's bytes as they are: common/image_io.h decodes what is used. Those in buffer
/// views are found later, with their bounds checked.
bool keep_image(tinygltf::Image* image, int /*index*/, std::string* /*error*/,
                std::string* /*warning*/, int /*width*/, int /*height*/, const unsigned char* bytes,
                int count, void* /*user*/) {
  if (image->bufferView < 0 && bytes != nullptr && count > 0)
    image->image.assign(bytes, bytes + count);
  return true;
}

bool file_is_there(const std::string& name, void* user) {
  std::error_code ignored;
  return fs::is_regular_file(resolve_beside(*static_cast<const fs::path*>(user), name), ignored);
}

bool read_beside(std::vector<unsigned char>* out, std::string* error, const std::string& name,
                 void* user) {
  const auto bytes = read_file(resolve_beside(*static_cast<const fs::path*>(user), name));
  if (!bytes) {
    *error += bytes.error().message;
    return false;
  }
  const auto* const begin = reinterpret_cast<const unsigned char*>(bytes->data());
  out->assign(begin, begin + bytes->size());
  return true;
}

bool refuse_to_write(std::string* /*error*/, const std::string& /*name*/,
                     const std::vector<unsigned char>& /*bytes*/, void* /*user*/) {
  return false;
}

/// Lets tinygltf read files beside the glTF file only. All callbacks are set: version 2.9 would
/// otherwise go on with its own, which open any file. Versions from 2.8 on also ask for a file's
/// size, and refuse files of more than 2 GiB by default.
void read_files_beside(auto& loader, fs::path& owner) {
  const auto set_callbacks = [&](auto callbacks) {
    callbacks.FileExists = file_is_there;
    callbacks.ExpandFilePath = [](const std::string& name, void*) { return name; };
    callbacks.ReadWholeFile = read_beside;
    callbacks.WriteWholeFile = refuse_to_write;
    callbacks.user_data = &owner;
    if constexpr (requires { callbacks.GetFileSizeInBytes; }) {
      callbacks.GetFileSizeInBytes = [](std::size_t* size, std::string* error,
                                        const std::string& name, void* user) {
        std::error_code failed;
        const auto found =
            fs::file_size(resolve_beside(*static_cast<const fs::path*>(user), name), failed);
        if (failed) *error += failed.message();
        *size = failed ? 0 : static_cast<std::size_t>(found);
        return !failed;
      };
    }
    loader.SetFsCallbacks(callbacks);
  };
  set_callbacks(tinygltf::FsCallbacks{});
  if constexpr (requires { loader.SetMaxExternalFileSize(SIZE_MAX); })
    loader.SetMaxExternalFileSize(SIZE_MAX);
}

/// The first line of what tinygltf says.
std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "it is no glTF 2.0" : line;
}

glm::dmat4 transform_of(const tinygltf::Node& node) {
  glm::dmat4 matrix(1.0);
  if (node.matrix.size() == 16) {
    for (glm::length_t k = 0; k < 16; ++k)
      matrix[k / 4][k % 4] = node.matrix[static_cast<std::size_t>(k)];
    return matrix;
  }
  if (node.translation.size() == 3)
    matrix[3] = {node.translation[0], node.translation[1], node.translation[2], 1.0};
  if (node.rotation.size() == 4) {
    matrix = matrix * glm::mat4_cast(glm::normalize(glm::dquat(
                          node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2])));
  }
  if (node.scale.size() == 3) {
    for (glm::length_t c = 0; c < 3; ++c) matrix[c] *= node.scale[static_cast<std::size_t>(c)];
  }
  return matrix;
}

class GltfReader {
 public:
  explicit GltfReader(const Source& source) : source_(source), path_(source.name) {}

  Result<Points> read() {
    RELIEF_TRY(parse());
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
    return std::move(points_);
  }

 private:
  Error wrong(const Status& why) const {
    return make_error("{}: {}", source_.name, why.error().message);
  }

  Status parse() {
    if (nests_too_deep(source_.text.substr(0, json_end())))
      return make_error("{}: its JSON nests deeper than {} levels", source_.name, kMaxDepth);
    tinygltf::TinyGLTF loader;
    loader.SetImageLoader(keep_image, nullptr);
    read_files_beside(loader, path_);
    std::string error;
    std::string warning;
    const auto size = static_cast<unsigned int>(source_.text.size());
    if (source_.text.size() > UINT32_MAX)
      return make_error("{}: is larger than the 4 GiB that glTF allows", source_.name);
    const auto load = [&]() -> Status {
      const char* const text = source_.text.data();
      const bool good =
          is_glb(source_.text)
              ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                            reinterpret_cast<const unsigned char*>(text), size)
              : loader.LoadASCIIFromString(&model_, &error, &warning, text, size, "");
      if (good) return {};
      return make_error("{}: cannot be read as glTF: {}", source_.name, first_line(error));
    };
    // tinygltf 2.8 throws std::out_of_range on a buffer of no bytes.
    return guarded({.subject = source_.name, .task = "read it", .library = "tinygltf"}, load);
  }

  /// Of a binary file the JSON is its first chunk, after 20 bytes.
  [[nodiscard]] std::size_t json_end() const {
    if (!is_glb(source_.text) || source_.text.size() < 20) return source_.text.size();
    std::uint32_t length = 0;
    std::memcpy(&length, source_.text.data() + 12, 4);
    return std::min<std::size_t>(source_.text.size(), std::size_t{20} + length);
  }

  /// One for each of the file's, once with texture coordinates and once without.
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
    std::vector<std::pair<int, glm::dmat4>> to_do;
    if (model_.scenes.empty()) {
      std::vector<bool> is_child(model_.nodes.size(), false);
      for (const tinygltf::Node& node : model_.nodes) {
        for (const int child : node.children) {
          if (child >= 0 && static_cast<std::size_t>(child) < is_child.size())
            is_child[static_cast<std::size_t>(child)] = true;
        }
      }
      for (std::size_t n = 0; n < is_child.size(); ++n) {
        if (!is_child[n]) to_do.emplace_back(static_cast<int>(n), glm::dmat4(1.0));
      }
    } else {
      const auto scene = static_cast<std::size_t>(std::max(model_.defaultScene, 0));
      if (scene >= model_.scenes.size()) return make_error("there is no scene {}", scene);
      for (const int node : model_.scenes[scene].nodes) to_do.emplace_back(node, glm::dmat4(1.0));
    }
    std::vector<bool> seen(model_.nodes.size(), false);
    while (!to_do.empty()) {
      const auto [index, parent] = to_do.back();
      to_do.pop_back();
      if (index < 0 || static_cast<std::size_t>(index) >= model_.nodes.size())
        return make_error("there is no node {}", index);
      if (seen[static_cast<std::size_t>(index)])
        return make_error("node {} has several parents, or is its own", index);
      seen[static_cast<std::size_t>(index)] = true;
      const tinygltf::Node& node = model_.nodes[static_cast<std::size_t>(index)];
      const glm::dmat4 placed = parent * transform_of(node);
      if (node.mesh >= 0) {
        RELIEF_TRY(read_mesh(node.mesh, placed));
      }
      for (const int child : node.children) to_do.emplace_back(child, placed);
    }
    return {};
  }

  Status read_mesh(int index, const glm::dmat4& placed) {
    if (static_cast<std::size_t>(index) >= model_.meshes.size())
      return make_error("there is no mesh {}", index);
    if (source_.progress.cancelled()) return interrupted_error();
    for (const tinygltf::Primitive& primitive :
         model_.meshes[static_cast<std::size_t>(index)].primitives) {
      if (Status done = read_primitive(primitive, placed); !done)
        return make_error("mesh {}: {}", index, done.error().message);
    }
    return {};
  }

  Status read_primitive(const tinygltf::Primitive& primitive, const glm::dmat4& placed) {
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
      points_.positions.emplace_back(placed * glm::dvec4(p[0], p[1], p[2], 1.0));
    }
    RELIEF_TRY(read_normals(attribute("NORMAL"), count, placed));
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
    RELIEF_TRY(keep_tangents(attribute("TANGENT"), count, placed));
    const std::uint32_t material =
        is_material ? 2 * static_cast<std::uint32_t>(primitive.material) + (texcoords < 0 ? 1U : 0U)
                    : kNoMaterial;
    return read_triangles(primitive, first, count, material, glm::determinant(placed) < 0.0);
  }

  Status read_normals(int accessor, std::size_t count, const glm::dmat4& placed) {
    points_.normals.resize(points_.size(), glm::vec3(0.0F));
    if (accessor < 0) return {};
    RELIEF_TRY_ASSIGN(const auto normals, read_accessor(model_, accessor, 3));
    const glm::dmat3 turn = glm::transpose(glm::inverse(glm::dmat3(placed)));
    for (std::size_t k = 0; k < std::min(count, normals.size() / 3); ++k) {
      const double* n = normals.data() + 3 * k;
      points_.normals[points_.size() - count + k] = turn * glm::dvec3(n[0], n[1], n[2]);
    }
    has_normals_ = true;
    return {};
  }

  /// Of the vertices, linear and perhaps with alpha. They count where all have them.
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

  /// Colours of vertices are a factor of those of materials: alone they count where these are
  /// white, which is what exporters of coloured points write.
  void choose_colours() {
    const bool all_white = std::ranges::all_of(points_.materials, [](const MeshMaterial& m) {
      return m.colour == glm::vec3(1.0F) && m.picture.empty() && m.image_bytes == nullptr &&
             m.normals.picture.empty() && m.normals.image_bytes == nullptr;
    });
    if (points_.colours.size() != points_.size() || !all_white) {
      points_.colours.clear();
    } else {
      points_.materials.clear();
      points_.triangle_materials.clear();
    }
  }

  /// glTF counts v downward.
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

  Status keep_tangents(int accessor, std::size_t count, const glm::dmat4& placed) {
    if (accessor < 0) return {};
    RELIEF_TRY_ASSIGN(auto tangents, read_tangents(model_, accessor, count, placed));
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
        // clean_points drops triangles of points that do not exist.
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
  fs::path path_;
  tinygltf::Model model_;
  Points points_;
  GltfTextures textures_{model_};
  std::vector<glm::vec4> tangents_;  ///< by point, up to the last that has one
  bool has_normals_ = false;
  bool has_texcoords_ = false;
};

}  // namespace

bool is_glb(std::string_view text) {
  return text.starts_with("glTF");
}

Result<Points> read_gltf(const Source& source) {
  return GltfReader(source).read();
}

}  // namespace relief
