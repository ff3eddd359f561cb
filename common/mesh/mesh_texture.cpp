#include "common/mesh/mesh_texture.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace relief {
namespace {

/// The pixel's colour where it is not wholly transparent.
bool straight_colour(const std::array<const Channel*, 4>& channels, std::size_t k,
                     glm::vec3& colour) {
  const float alpha = channels[3] == nullptr ? 1.0F : channels[3]->values[k];
  if (!(alpha > 0.0F)) return false;
  for (std::size_t c = 0; c < 3; ++c)
    colour[static_cast<glm::length_t>(c)] = channels[c]->values[k] / std::min(alpha, 1.0F);
  return true;
}

}  // namespace

Result<MeshTexture> MeshTexture::from_image(const Image& image, TextureWrap wrap) {
  const std::array<const Channel*, 4> channels{image.find("R"), image.find("G"), image.find("B"),
                                               image.find("A")};
  if (std::find(channels.begin(), channels.begin() + 3, nullptr) != channels.begin() + 3)
    return make_error("the texture has no channels R, G and B");
  const std::size_t count = std::size_t{image.width} * image.height;
  if (count == 0) return make_error("the texture has no pixels");
  std::vector<glm::u8vec3> texels(count);
  std::vector<std::size_t> transparent;
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < count; ++k) {
    glm::vec3 colour(0.0F);
    if (!straight_colour(channels, k, colour)) {
      transparent.push_back(k);
      continue;
    }
    texels[k] = srgb8_from_linear(colour);
    sum += linear_from_srgb8(texels[k]);
  }
  if (transparent.size() == count) return make_error("every pixel of the texture is transparent");
  const glm::u8vec3 mean =
      srgb8_from_linear(glm::vec3(sum / static_cast<double>(count - transparent.size())));
  for (const std::size_t k : transparent) texels[k] = mean;
  return MeshTexture(image.width, image.height, std::move(texels), wrap);
}

}  // namespace relief
