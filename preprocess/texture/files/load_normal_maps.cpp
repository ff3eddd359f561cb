#include "preprocess/texture/files/load_normal_maps.h"

#include <map>
#include <memory>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "common/image/image_io.h"
#include "common/io/file.h"
#include "common/mesh/normal_texture.h"
#include "preprocess/readers/source.h"
#include "preprocess/texture/files/decode_texture.h"

namespace relief {
namespace {

using SharedTexture = std::shared_ptr<const NormalTexture>;

Result<SharedTexture> decode(const std::string& name, std::span<const std::byte> bytes,
                             TextureWrap wrap) {
  return decode_texture<NormalTexture>(name, decode_image(name, bytes, Transfer::None), wrap,
                                       "normal map");
}

Result<SharedTexture> read(const std::filesystem::path& mesh, const MeshNormalMap& map) {
  const TextureWrap wrap = wrap_of(map.clamps);
  if (map.image_bytes != nullptr)
    return decode(fmt::format("{}: {}", mesh.string(), map.image), *map.image_bytes, wrap);
  RELIEF_TRY_ASSIGN(const auto bytes, read_file(map.image));
  return decode(map.image, bytes, wrap);
}

}  // namespace

Status load_normal_maps(const std::filesystem::path& mesh, Points& points,
                        std::vector<std::string>& notes) {
  std::map<std::tuple<const void*, std::string, bool>, SharedTexture> textures;
  std::set<std::string>
      reported;  // a material is split in two if some of its faces have no coordinates
  for (MeshMaterial& material : points.materials) {
    MeshNormalMap& map = material.normals;
    if (!map.left_out.empty() && reported.insert(material.name).second) {
      notes.push_back(fmt::format("{}: material {}: {}", mesh.string(),
                                  relief::quoted(material.name), map.left_out));
    }
    if (map.image.empty() || !map.left_out.empty() || !material.has_texcoords ||
        points.texcoords.empty())
      continue;
    const void* const bytes = map.image_bytes.get();
    const std::tuple key(bytes, bytes == nullptr ? map.image : std::string(), map.clamps);
    auto texture = textures.find(key);
    if (texture == textures.end()) {
      auto made = read(mesh, map);
      if (!made) {
        return make_error("{} (the normal map of material {} of {}; --texture none does without)",
                          made.error().message, relief::quoted(material.name), mesh.string());
      }
      texture = textures.emplace(key, std::move(*made)).first;
    }
    map.texture = texture->second;
  }
  for (MeshMaterial& material : points.materials) material.normals.image_bytes.reset();
  return {};
}

}  // namespace relief
