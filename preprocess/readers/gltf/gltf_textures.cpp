#include "preprocess/readers/gltf/gltf_textures.h"

#include <cmath>
#include <span>
#include <utility>

#include "preprocess/readers/source.h"

namespace relief {

Result<MeshImage> GltfTextures::read(int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= model_.textures.size())
    return make_error("there is no texture {}", index);
  const tinygltf::Texture& texture = model_.textures[static_cast<std::size_t>(index)];
  if (texture.source < 0 || static_cast<std::size_t>(texture.source) >= model_.images.size())
    return make_error("texture {} has no image that can be read", index);
  MeshImage out;
  if (texture.sampler >= 0 && static_cast<std::size_t>(texture.sampler) < model_.samplers.size()) {
    const tinygltf::Sampler& sampler = model_.samplers[static_cast<std::size_t>(texture.sampler)];
    out.clamps = sampler.wrapS == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE &&
                 sampler.wrapT == TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
  }
  RELIEF_TRY_ASSIGN(auto bytes, image_of(texture.source));
  out.image = name_of(texture.source);
  out.image_bytes = std::move(bytes);
  return out;
}

Result<MeshNormalMap> GltfTextures::read_normals(const tinygltf::NormalTextureInfo& info,
                                                 int texcoord_set) {
  MeshNormalMap map;
  if (info.index < 0) return map;
  if (info.texCoord != texcoord_set) {
    map.left_out = fmt::format(
        "its normal map has its own texture coordinates (TEXCOORD_{}), "
        "which are not read",
        info.texCoord);
    return map;
  }
  RELIEF_TRY_ASSIGN(auto texture, read(info.index));
  static_cast<MeshImage&>(map) = std::move(texture);
  if (std::abs(info.scale) <= MeshNormalMap::kLargestScale)
    map.scale = static_cast<float>(info.scale);
  return map;
}

std::string GltfTextures::name_of(int image) const {
  const std::string& uri = model_.images[static_cast<std::size_t>(image)].uri;
  return uri.empty() ? fmt::format("image {}", image) : relief::quoted(uri);
}

Result<std::shared_ptr<const std::vector<std::byte>>> GltfTextures::image_of(int index) {
  images_.resize(model_.images.size());
  auto& kept = images_[static_cast<std::size_t>(index)];
  if (kept != nullptr) return kept;
  const tinygltf::Image& image = model_.images[static_cast<std::size_t>(index)];
  std::span<const std::byte> bytes = std::as_bytes(std::span(image.image));
  if (image.bufferView >= 0) {
    RELIEF_TRY_ASSIGN(const auto in_buffer, view_bytes(model_, image.bufferView));
    bytes = in_buffer;
  }
  if (bytes.empty()) {
    return make_error("its texture {} cannot be read; put it beside the file, or use --texture",
                      name_of(index));
  }
  kept = std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
  return kept;
}

int texcoord_set_of(const tinygltf::Material& material) {
  const auto& base = material.pbrMetallicRoughness.baseColorTexture;
  return base.index < 0 && material.normalTexture.index >= 0 ? material.normalTexture.texCoord
                                                             : base.texCoord;
}

}  // namespace relief
