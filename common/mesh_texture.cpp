#include "common/mesh_texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>

#include "common/srgb.h"

namespace relief {
namespace {

/// More places along a footprint are averaged at a coarser level.
constexpr float kMostPlaces = 16.0F;

/// Texel `i` along an axis of `size` texels; what is outside as the texture wraps.
std::uint32_t wrapped(std::int64_t i, std::uint32_t size, TextureWrap wrap) {
  const auto n = std::int64_t{size};
  if (wrap == TextureWrap::Clamp)
    return static_cast<std::uint32_t>(std::clamp(i, std::int64_t{0}, n - 1));
  const std::int64_t rest = i % n;
  return static_cast<std::uint32_t>(rest < 0 ? rest + n : rest);
}

/// A texture coordinate in or near [0, 1], so that its texel fits into 64 bits. In double
/// precision, for v is still to be taken from 1.
double near_texture(float coordinate, TextureWrap wrap) {
  const double c{coordinate};
  return wrap == TextureWrap::Repeat ? c - std::floor(c) : std::clamp(c, -1.0, 2.0);
}

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

MeshTexture::MeshTexture(std::uint32_t width, std::uint32_t height, std::vector<glm::u8vec3> texels,
                         TextureWrap wrap)
    : wrap_(wrap) {
  assert(width > 0 && height > 0 && texels.size() == std::size_t{width} * height);
  levels_.push_back({width, height, std::move(texels)});
  while (levels_.back().texels.size() > 1) levels_.push_back(halve(levels_.back()));
}

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

MeshTexture::Level MeshTexture::halve(const Level& finer) {
  Level coarser{std::max(finer.width / 2, 1U), std::max(finer.height / 2, 1U), {}};
  coarser.texels.reserve(std::size_t{coarser.width} * coarser.height);
  // The texels that a coarser one covers: two along an axis, three where an odd one is left over.
  const auto span = [](std::uint32_t k, std::uint32_t fine, std::uint32_t coarse) {
    return std::pair(static_cast<std::uint32_t>(std::uint64_t{k} * fine / coarse),
                     static_cast<std::uint32_t>((std::uint64_t{k} + 1) * fine / coarse));
  };
  for (std::uint32_t y = 0; y < coarser.height; ++y) {
    const auto [top, bottom] = span(y, finer.height, coarser.height);
    for (std::uint32_t x = 0; x < coarser.width; ++x) {
      const auto [left, right] = span(x, finer.width, coarser.width);
      glm::vec3 sum(0.0F);
      for (std::uint32_t j = top; j < bottom; ++j) {
        for (std::uint32_t i = left; i < right; ++i)
          sum += linear_from_srgb8(finer.texels[std::size_t{j} * finer.width + i]);
      }
      coarser.texels.push_back(
          srgb8_from_linear(sum / static_cast<float>((bottom - top) * (right - left))));
    }
  }
  return coarser;
}

glm::vec3 MeshTexture::bilinear(const Level& level, glm::vec2 texcoord) const {
  const double x = near_texture(texcoord.x, wrap_) * level.width - 0.5;
  const double y = (1.0 - near_texture(texcoord.y, wrap_)) * level.height - 0.5;
  const glm::dvec2 corner(std::floor(x), std::floor(y));
  const glm::vec2 part(glm::dvec2(x, y) - corner);
  const auto column = [&](std::int64_t i) { return wrapped(i, level.width, wrap_); };
  const auto row = [&](std::int64_t j) {
    return std::size_t{wrapped(j, level.height, wrap_)} * level.width;
  };
  const auto i = static_cast<std::int64_t>(corner.x);
  const auto j = static_cast<std::int64_t>(corner.y);
  const auto texel = [&](std::int64_t a, std::int64_t b) {
    return linear_from_srgb8(level.texels[row(b) + column(a)]);
  };
  return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), part.x),
                  glm::mix(texel(i, j + 1), texel(i + 1, j + 1), part.x), part.y);
}

glm::vec3 MeshTexture::trilinear(glm::vec2 texcoord, float level) const {
  const float last = static_cast<float>(levels_.size() - 1);
  const float clamped = std::clamp(level, 0.0F, last);
  const auto finer = static_cast<std::size_t>(clamped);
  const float part = clamped - std::floor(clamped);
  const glm::vec3 one = bilinear(levels_[finer], texcoord);
  if (part == 0.0F) return one;
  return glm::mix(one, bilinear(levels_[finer + 1], texcoord), part);
}

glm::vec3 MeshTexture::at(glm::vec2 texcoord) const {
  return bilinear(levels_.front(), texcoord);
}

glm::vec3 MeshTexture::mean(glm::vec2 texcoord, glm::vec2 du, glm::vec2 dv) const {
  const glm::vec2 size(width(), height());
  float longer = glm::length(du * size);
  float shorter = glm::length(dv * size);
  glm::vec2 along = du;
  if (shorter > longer) {
    std::swap(longer, shorter);
    along = dv;
  }
  if (!(longer > 1.0F) || !std::isfinite(longer)) return at(texcoord);
  const float places = std::clamp(std::ceil(longer / std::max(shorter, 1.0F)), 1.0F, kMostPlaces);
  const float level = std::log2(std::max(longer / places, 1.0F));
  glm::vec3 sum(0.0F);
  const auto count = static_cast<int>(places);
  for (int k = 0; k < count; ++k)
    sum += trilinear(texcoord + ((static_cast<float>(k) + 0.5F) / places - 0.5F) * along, level);
  return sum / places;
}

}  // namespace relief
