#include "preprocess/texture/files/load_textures.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "common/image/image_io.h"
#include "common/io/file.h"
#include "common/mesh/mesh_texture.h"
#include "preprocess/readers/obj/mtl.h"
#include "preprocess/readers/source.h"
#include "preprocess/readers/text_cursor.h"
#include "preprocess/texture/files/decode_texture.h"
#include "preprocess/texture/files/load_normal_maps.h"

namespace relief {
namespace {

namespace fs = std::filesystem;

/// A material and its material file.
struct FoundMaterial {
  MtlMaterial entry;
  fs::path file;
};
using FoundMaterials = std::map<std::string, FoundMaterial, std::less<>>;

/// Returns the material files of a `mtllib` line. It may name several, and names may have blanks.
std::vector<fs::path> material_files(const fs::path& mesh, const std::string& line) {
  std::error_code ignored;
  const fs::path whole = resolve_beside(mesh, line);
  if (fs::exists(whole, ignored)) return {whole};
  std::vector<fs::path> files;
  TextCursor words(line);
  if (!words.next_line()) return files;
  for (std::string_view word = words.word(); !word.empty(); word = words.word())
    files.push_back(resolve_beside(mesh, std::string(word)));
  return files;
}

Result<FoundMaterials> read_material_files(const fs::path& mesh, const Points& points,
                                           std::vector<std::string>& notes) {
  FoundMaterials found;
  for (const std::string& line : points.material_files) {
    for (const fs::path& file : material_files(mesh, line)) {
      std::error_code ignored;
      if (!fs::exists(file, ignored)) {
        notes.push_back(
            fmt::format("{}: its materials are in {}, which is not there; they are "
                        "left out",
                        mesh.string(), file.string()));
        continue;
      }
      RELIEF_TRY_ASSIGN(const auto bytes, read_file(file));
      const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
      RELIEF_TRY_ASSIGN(auto materials, read_mtl(file.string(), text));
      for (MtlMaterial& material : materials) {
        std::string name = material.material.name;
        found.try_emplace(std::move(name), FoundMaterial{std::move(material), file});
      }
    }
  }
  return found;
}

Result<std::shared_ptr<const MeshTexture>> read_texture(const fs::path& file, TextureWrap wrap) {
  return decode_texture<MeshTexture>(file.string(), read_image(file), wrap, "texture");
}

bool are_finite(const CornerTexcoords& corners) {
  return std::all_of(corners.begin(), corners.end(),
                     [](glm::vec2 v) { return std::isfinite(v.x) && std::isfinite(v.y); });
}

/// Triangles with NaN or infinite texture coordinates get no texture.
void drop_bad_texcoords(Points& points) {
  for (std::size_t t = 0; t < points.triangle_materials.size(); ++t) {
    std::uint32_t& material = points.triangle_materials[t];
    if (material == kNoMaterial) continue;
    const MeshMaterial& look = points.materials[material];
    if (look.texture == nullptr && look.normals.texture == nullptr) continue;
    if (!are_finite(texcoords_of(points, t))) material = kNoMaterial;
  }
}

Status put_on_all(const fs::path& mesh, const TextureChoice& choice, Points& points) {
  const fs::path& image = choice.image;
  const bool lacks_faces = points.triangles.empty() && !choice.of_points;
  if (lacks_faces || points.texcoords.empty()) {
    return make_error("{}: it has no {}, so the texture {} cannot be put on it", mesh.string(),
                      lacks_faces ? "faces" : "texture coordinates", image.string());
  }
  RELIEF_TRY_ASSIGN(auto texture, read_texture(image, TextureWrap::Repeat));
  MeshMaterial material;
  material.name = image.filename().string();
  material.image = image.string();
  material.texture = std::move(texture);
  points.materials = {std::move(material)};
  points.triangle_materials.assign(points.triangles.size(), 0);
  drop_bad_texcoords(points);
  return {};
}

/// Reads the image that a material of the mesh file itself names (PLY), if it does.
Status read_named_texture(const fs::path& mesh, MeshMaterial& material) {
  if (material.image.empty()) return {};
  const fs::path file = resolve_beside(mesh, material.image);
  auto read = read_texture(file, wrap_of(material.clamps));
  if (!read) {
    return make_error("{} (the texture of {}; --texture names another, and none does without)",
                      read.error().message, mesh.string());
  }
  material.image = file.string();
  material.texture = std::move(*read);
  return {};
}

/// Reads the images of materials defined in the mesh file itself.
Status read_stated_textures(const fs::path& mesh, Points& points) {
  std::map<std::pair<const void*, bool>, std::shared_ptr<const MeshTexture>> textures;
  for (MeshMaterial& material : points.materials) {
    if (!material.is_stated || !material.has_texcoords) continue;
    if (material.image_bytes == nullptr) {
      RELIEF_TRY(read_named_texture(mesh, material));
      continue;
    }
    const std::pair key(static_cast<const void*>(material.image_bytes.get()), material.clamps);
    auto texture = textures.find(key);
    if (texture == textures.end()) {
      const std::string name = fmt::format("{}: {}", mesh.string(), material.image);
      RELIEF_TRY_ASSIGN(auto made,
                        decode_texture<MeshTexture>(name, decode_image(name, *material.image_bytes),
                                                    wrap_of(material.clamps), "texture"));
      texture = textures.emplace(key, std::move(made)).first;
    }
    material.texture = texture->second;
  }
  for (MeshMaterial& material : points.materials) material.image_bytes.reset();
  return {};
}

/// Takes a material's normal map from its material file.
void take_normals(const FoundMaterial& found, MeshMaterial& material,
                  std::vector<std::string>& notes) {
  material.normals = found.entry.material.normals;
  if (material.normals.image.empty() || !material.has_texcoords) return;
  material.normals.image = resolve_beside(found.file, material.normals.image).string();
  if (found.entry.ignored_of_normals.empty()) return;
  notes.push_back(fmt::format("{}: normal map of material {}: {} is not read", found.file.string(),
                              relief::quoted(material.name), found.entry.ignored_of_normals));
}

/// Completes the materials that triangles name from the material files.
Status resolve_materials(const fs::path& mesh, Points& points, std::vector<std::string>& notes) {
  RELIEF_TRY_ASSIGN(const auto found, read_material_files(mesh, points, notes));
  RELIEF_TRY(read_stated_textures(mesh, points));
  std::map<std::pair<fs::path, bool>, std::shared_ptr<const MeshTexture>> textures;
  std::vector<bool> known(points.materials.size(), true);
  for (std::size_t m = 0; m < points.materials.size(); ++m) {
    MeshMaterial& material = points.materials[m];
    if (material.is_stated) continue;
    const auto it = found.find(material.name);
    known[m] = it != found.end();
    if (!known[m]) continue;
    const MtlMaterial& entry = it->second.entry;
    material.colour = entry.material.colour;
    take_normals(it->second, material, notes);
    if (entry.material.image.empty() || !material.has_texcoords || points.texcoords.empty())
      continue;
    const fs::path file = resolve_beside(it->second.file, entry.material.image);
    const std::pair key(file, entry.material.clamps);
    auto texture = textures.find(key);
    if (texture == textures.end()) {
      auto read = read_texture(file, wrap_of(entry.material.clamps));
      if (!read) {
        return make_error(
            "{} (the texture of material {} of {}; --texture names another, and none "
            "does without)",
            read.error().message, relief::quoted(material.name), mesh.string());
      }
      texture = textures.emplace(key, std::move(*read)).first;
    }
    if (!entry.ignored_options.empty()) {
      notes.push_back(fmt::format("{}: map_Kd of material {}: {} is not read",
                                  it->second.file.string(), relief::quoted(material.name),
                                  entry.ignored_options));
    }
    material.image = file.string();
    material.texture = texture->second;
    material.colour = glm::vec3(1.0F);
  }
  for (std::uint32_t& material : points.triangle_materials) {
    if (material != kNoMaterial && !known[material]) material = kNoMaterial;
  }
  Status loaded = load_normal_maps(mesh, points, notes);
  if (loaded) drop_bad_texcoords(points);
  return loaded;
}

/// Tells a user whose mesh could have a picture, and has no colours instead, how to name it.
void note_missing_picture(const fs::path& mesh, const Points& points,
                          std::vector<std::string>& notes) {
  if (points.triangles.empty() || points.texcoords.empty() || !points.colours.empty()) return;
  if (has_triangle_colours(points)) return;
  notes.push_back(
      fmt::format("{}: has texture coordinates, and no picture is found for them; --texture FILE "
                  "names one",
                  mesh.string()));
}

void leave_out(Points& points) {
  points.materials.clear();
  points.triangle_materials.clear();
}

}  // namespace

fs::path resolve_beside(const fs::path& owner, const std::string& name) {
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const fs::path inside = fs::path(slashes).lexically_normal();
  const bool has_drive = slashes.size() > 1 && slashes[1] == ':';
  const bool leaves =
      inside.is_absolute() || has_drive || (!inside.empty() && *inside.begin() == fs::path(".."));
  return owner.parent_path() / (leaves ? fs::path(slashes).filename() : inside);
}

void flip_v(Points& points) {
  for (glm::vec2& texcoord : points.texcoords) texcoord.y = 1.0F - texcoord.y;
  for (CornerTexcoords& corners : points.corner_texcoords) {
    for (glm::vec2& texcoord : corners) texcoord.y = 1.0F - texcoord.y;
  }
  for (CornerTangents& corners : points.corner_tangents) {
    for (glm::vec4& tangent : corners) tangent.w = -tangent.w;
  }
}

bool has_triangle_colours(const Points& points) {
  return std::any_of(points.triangle_materials.begin(), points.triangle_materials.end(),
                     [](std::uint32_t material) { return material != kNoMaterial; });
}

Status load_textures(const fs::path& mesh, const TextureChoice& choice, Points& points,
                     std::vector<std::string>& notes) {
  Status done;
  if (choice.flips_v) flip_v(points);
  if (choice.left_out) {
    leave_out(points);
  } else if (!choice.image.empty()) {
    done = put_on_all(mesh, choice, points);
  } else {
    done = resolve_materials(mesh, points, notes);
    // A missing material file has a note of its own.
    if (done && notes.empty()) note_missing_picture(mesh, points, notes);
  }
  points.material_files.clear();
  const bool of_points = choice.of_points && points.triangles.empty();
  if (done && !of_points && !has_triangle_colours(points)) leave_out(points);
  return done;
}

}  // namespace relief
