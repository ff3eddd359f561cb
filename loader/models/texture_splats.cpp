#include "loader/models/texture_splats.h"

#include <cmath>
#include <limits>

#include "common/mesh/mesh_texture.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

/// What a point has of a mesh's materials.
struct Look {
  std::uint32_t material = kNoMaterial;
  glm::vec2 texcoord{kNaN};  ///< v upward
};

std::vector<Look> looks_of(const Points& points) {
  std::vector<Look> looks(points.size());
  if (points.triangles.empty() && !points.materials.empty()) {
    for (std::size_t k = 0; k < looks.size(); ++k) looks[k] = {0, points.texcoords[k]};
    return looks;
  }
  for (std::size_t t = 0; t < points.triangle_materials.size(); ++t) {
    const std::uint32_t material = points.triangle_materials[t];
    if (material == kNoMaterial) continue;
    const bool has_texture = points.materials[material].texture != nullptr;
    CornerTexcoords corners;
    corners.fill(glm::vec2(kNaN));
    if (has_texture) corners = texcoords_of(points, t);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Look& look = looks[points.triangles[t][corner]];
      if (look.material == kNoMaterial) look = {material, corners[corner]};
    }
  }
  return looks;
}

/// The material with a texture that most points have; kNoMaterial if none has one.
std::uint32_t commonest(const Points& points, const std::vector<Look>& looks) {
  std::vector<std::size_t> counts(points.materials.size());
  for (const Look& look : looks) {
    if (look.material != kNoMaterial && points.materials[look.material].texture != nullptr)
      ++counts[look.material];
  }
  std::uint32_t best = kNoMaterial;
  for (std::uint32_t m = 0; m < counts.size(); ++m) {
    if (counts[m] > (best == kNoMaterial ? 0 : counts[best])) best = m;
  }
  return best;
}

Image image_of(const MeshTexture& texture, glm::vec3 colour) {
  Image image{texture.width(), texture.height(), {}};
  const std::size_t count = std::size_t{image.width} * image.height;
  for (const char* const name : {"R", "G", "B"}) {
    image.channels.push_back({name, ChannelType::Float, {}});
    image.channels.back().values.reserve(count);
  }
  for (std::uint32_t y = 0; y < image.height; ++y) {
    for (std::uint32_t x = 0; x < image.width; ++x) {
      const glm::vec2 middle(
          (static_cast<float>(x) + 0.5F) / static_cast<float>(image.width),
          1.0F - (static_cast<float>(y) + 0.5F) / static_cast<float>(image.height));
      const glm::vec3 texel = texture.at(middle) * colour;
      for (glm::length_t c = 0; c < 3; ++c)
        image.channels[static_cast<std::size_t>(c)].values.push_back(texel[c]);
    }
  }
  return image;
}

}  // namespace

void texture_splats(const Points& points, SplatCloud& cloud) {
  const std::vector<Look> looks = looks_of(points);
  const std::uint32_t textured = commonest(points, looks);
  if (textured != kNoMaterial) {
    const MeshMaterial& material = points.materials[textured];
    cloud.texture = std::make_shared<const Image>(image_of(*material.texture, material.colour));
    cloud.texcoords.assign(looks.size(), glm::vec2(kNaN));
  }
  for (std::size_t k = 0; k < looks.size(); ++k) {
    const auto& [index, texcoord] = looks[k];
    if (index == kNoMaterial) continue;
    const MeshMaterial& material = points.materials[index];
    glm::vec3 colour = material.colour;
    const bool is_placed = std::isfinite(texcoord.x) && std::isfinite(texcoord.y);
    if (material.texture != nullptr && is_placed) {
      colour *= material.texture->at(texcoord);
      if (index == textured) cloud.texcoords[k] = {texcoord.x, 1.0F - texcoord.y};
    }
    if (cloud.colours.empty())
      cloud.colours.assign(looks.size(), glm::vec4(glm::vec3(shared::kNeutralGrey), 1.0F));
    cloud.colours[k] = {colour, 1.0F};
  }
}

}  // namespace relief
