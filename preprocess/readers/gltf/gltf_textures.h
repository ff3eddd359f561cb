// Reads the textures of a glTF file's materials. Not a public header: it needs tinygltf.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "preprocess/readers/gltf/gltf_accessor.h"

namespace relief {

/// Finds textures by index. Indices are not trusted. Errors are clauses.
class GltfTextures {
 public:
  /// The model must outlive this object and keep its images undecoded.
  explicit GltfTextures(const tinygltf::Model& model) : model_(model) {}

  /// Returns an undecoded texture; `image` is the image's name for messages. Textures with a common
  /// image share its bytes.
  Result<MeshImage> read(int index);

  /// Returns the normal map of a material whose texture coordinates are the set `texcoord_set`. A
  /// map with another set is left out, because a point has one texture coordinate.
  Result<MeshNormalMap> read_normals(const tinygltf::NormalTextureInfo& info, int texcoord_set);

 private:
  /// `image` must be a valid index.
  [[nodiscard]] std::string name_of(int image) const;
  Result<std::shared_ptr<const std::vector<std::byte>>> image_of(int index);

  const tinygltf::Model& model_;
  std::vector<std::shared_ptr<const std::vector<std::byte>>> images_;  ///< by image
};

/// Returns a material's set of texture coordinates: that of the base colour, or of the normal map
/// if there is no base colour texture.
[[nodiscard]] int texcoord_set_of(const tinygltf::Material& material);

}  // namespace relief
