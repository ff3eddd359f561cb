// The textures that a glTF file's materials name, as pictures in memory. Not a public header: it
// needs tinygltf.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "common/error.h"
#include "common/points.h"
#include "preprocess/readers/gltf/gltf_accessor.h"

namespace relief {

/// Finds textures by their index. No index of the file is trusted; errors are clauses.
class GltfTextures {
 public:
  /// The model must outlive it, and its images be kept as they are in the file.
  explicit GltfTextures(const tinygltf::Model& model) : model_(model) {}

  /// A texture, undecoded; `picture` is its image's name for messages. Textures that show one image
  /// share its bytes.
  Result<MeshPicture> read(int index);

  /// The normal map of a material, whose texture coordinates are the set `texcoord_set`: one that
  /// has others is left out, for a point has one texture coordinate.
  Result<MeshNormalMap> read_normals(const tinygltf::NormalTextureInfo& info, int texcoord_set);

 private:
  /// Of an image that there is.
  [[nodiscard]] std::string name_of(int image) const;
  Result<std::shared_ptr<const std::vector<std::byte>>> picture_of(int index);

  const tinygltf::Model& model_;
  std::vector<std::shared_ptr<const std::vector<std::byte>>> pictures_;  ///< by image
};

/// Which set of texture coordinates a material's textures have: that of the base colour's, or of
/// the normal map where there is no other.
[[nodiscard]] int texcoord_set_of(const tinygltf::Material& material);

}  // namespace relief
