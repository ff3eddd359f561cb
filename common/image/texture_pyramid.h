// Textures with mip levels, for colours and for normals.
#pragma once

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>
#include <vector>

namespace relief {

/// The continuation of a texture outside [0, 1]^2.
enum class TextureWrap : std::uint8_t { Repeat, Clamp };

/// Returns texel `i` along an axis of `size` texels, wrapped if it lies outside.
[[nodiscard]] inline std::uint32_t wrapped_texel(std::int64_t i, std::uint32_t size,
                                                 TextureWrap wrap) {
  const auto n = std::int64_t{size};
  if (wrap == TextureWrap::Clamp)
    return static_cast<std::uint32_t>(std::clamp(i, std::int64_t{0}, n - 1));
  const std::int64_t rest = i % n;
  return static_cast<std::uint32_t>(rest < 0 ? rest + n : rest);
}

/// Returns a texture coordinate reduced to [0, 1] or near it, so that its texel index fits into 64
/// bits. In double precision, because v is still subtracted from 1.
[[nodiscard]] inline double near_texture(float coordinate, TextureWrap wrap) {
  const double c{coordinate};
  return wrap == TextureWrap::Repeat ? c - std::floor(c) : std::clamp(c, -1.0, 2.0);
}

/// A texture and its mip levels, each the mean of the level before. `Codec` defines a texel: its
/// type `Texel`, the conversion to the filtered vector (`decode`) and back (`encode`).
template <class Codec>
class TexturePyramid {
 public:
  using Texel = typename Codec::Texel;

  /// Texels in row-major order, top row first. `width` and `height` above 0.
  TexturePyramid(std::uint32_t width, std::uint32_t height, std::vector<Texel> texels,
                 TextureWrap wrap)
      : wrap_(wrap) {
    assert(width > 0 && height > 0 && texels.size() == std::size_t{width} * height);
    levels_.push_back({width, height, std::move(texels)});
    while (levels_.back().texels.size() > 1) levels_.push_back(halve(levels_.back()));
  }

  /// Returns the value at (u, v), v upward: bilinear at the finest level. Finite for all finite (u,
  /// v).
  [[nodiscard]] glm::vec3 at(glm::vec2 texcoord) const {
    return bilinear(levels_.front(), texcoord);
  }

  /// Returns the mean over the parallelogram about (u, v) that `du` and `dv` span (texture
  /// coordinates). Anisotropic: trilinear taps at the level of the shorter side, spread along the
  /// longer side, at most 16 (McCormack et al. 1999, "Feline").
  [[nodiscard]] glm::vec3 mean(glm::vec2 texcoord, glm::vec2 du, glm::vec2 dv) const {
    const glm::vec2 size(width(), height());
    float longer = glm::length(du * size);
    float shorter = glm::length(dv * size);
    glm::vec2 along = du;
    if (shorter > longer) {
      std::swap(longer, shorter);
      along = dv;
    }
    if (!(longer > 1.0F) || !std::isfinite(longer)) return at(texcoord);
    const float taps = std::clamp(std::ceil(longer / std::max(shorter, 1.0F)), 1.0F, kMaxTaps);
    const float level = std::log2(std::max(longer / taps, 1.0F));
    glm::vec3 sum(0.0F);
    const auto count = static_cast<int>(taps);
    for (int k = 0; k < count; ++k)
      sum += trilinear(texcoord + ((static_cast<float>(k) + 0.5F) / taps - 0.5F) * along, level);
    return sum / taps;
  }

  [[nodiscard]] std::uint32_t width() const { return levels_.front().width; }
  [[nodiscard]] std::uint32_t height() const { return levels_.front().height; }

 private:
  struct Level {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::vector<Texel> texels;
  };

  /// A footprint that needs more taps is averaged at a coarser level.
  static constexpr float kMaxTaps = 16.0F;

  [[nodiscard]] static Level halve(const Level& finer) {
    Level coarser{std::max(finer.width / 2, 1U), std::max(finer.height / 2, 1U), {}};
    coarser.texels.reserve(std::size_t{coarser.width} * coarser.height);
    // The texels under a coarser one: two along an axis, or three if an odd one is left over.
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
            sum += Codec::decode(finer.texels[std::size_t{j} * finer.width + i]);
        }
        coarser.texels.push_back(
            Codec::encode(sum / static_cast<float>((bottom - top) * (right - left))));
      }
    }
    return coarser;
  }

  [[nodiscard]] glm::vec3 bilinear(const Level& level, glm::vec2 texcoord) const {
    const double x = near_texture(texcoord.x, wrap_) * level.width - 0.5;
    const double y = (1.0 - near_texture(texcoord.y, wrap_)) * level.height - 0.5;
    const glm::dvec2 corner(std::floor(x), std::floor(y));
    const glm::vec2 part(glm::dvec2(x, y) - corner);
    const auto column = [&](std::int64_t i) { return wrapped_texel(i, level.width, wrap_); };
    const auto row = [&](std::int64_t j) {
      return std::size_t{wrapped_texel(j, level.height, wrap_)} * level.width;
    };
    const auto i = static_cast<std::int64_t>(corner.x);
    const auto j = static_cast<std::int64_t>(corner.y);
    const auto texel = [&](std::int64_t a, std::int64_t b) {
      return Codec::decode(level.texels[row(b) + column(a)]);
    };
    return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), part.x),
                    glm::mix(texel(i, j + 1), texel(i + 1, j + 1), part.x), part.y);
  }

  [[nodiscard]] glm::vec3 trilinear(glm::vec2 texcoord, float level) const {
    const float last = static_cast<float>(levels_.size() - 1);
    const float clamped = std::clamp(level, 0.0F, last);
    const auto finer = static_cast<std::size_t>(clamped);
    const float part = clamped - std::floor(clamped);
    const glm::vec3 one = bilinear(levels_[finer], texcoord);
    if (part == 0.0F) return one;
    return glm::mix(one, bilinear(levels_[finer + 1], texcoord), part);
  }

  std::vector<Level> levels_;  ///< finest first; the last is one texel
  TextureWrap wrap_ = TextureWrap::Repeat;
};

}  // namespace relief
