#include "common/mesh/normal_texture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

namespace relief {
namespace {

/// Returns the unit vector of a pixel. `alpha` may be null.
glm::vec3 normal_of(const std::array<const Channel*, 3>& channels, const Channel* alpha,
                    std::size_t k) {
  const glm::vec3 flat(0.0F, 0.0F, 1.0F);
  const float opacity = alpha == nullptr ? 1.0F : std::min(alpha->values[k], 1.0F);
  if (!(opacity > 0.0F)) return flat;
  glm::vec3 stored(0.0F);
  for (std::size_t c = 0; c < 3; ++c)
    stored[static_cast<glm::length_t>(c)] = channels[c]->values[k] / opacity;
  glm::vec3 v = 2.0F * stored - 1.0F;
  v.z = std::max(v.z, 0.0F);
  const float length = glm::length(v);
  return std::isfinite(length) && length > 1e-3F ? v / length : flat;
}

}  // namespace

Result<NormalTexture> NormalTexture::from_image(const Image& image, TextureWrap wrap) {
  const std::array<const Channel*, 3> channels{image.find("R"), image.find("G"), image.find("B")};
  if (std::find(channels.begin(), channels.end(), nullptr) != channels.end())
    return make_error("the normal map has no channels R, G and B");
  const std::size_t count = std::size_t{image.width} * image.height;
  if (count == 0) return make_error("the normal map has no pixels");
  const Channel* const alpha = image.find("A");
  std::vector<glm::i16vec3> texels;
  texels.reserve(count);
  for (std::size_t k = 0; k < count; ++k) texels.push_back(texel_of(normal_of(channels, alpha, k)));
  return NormalTexture(image.width, image.height, std::move(texels), wrap);
}

}  // namespace relief
