#include "preprocess/texture/acquisition/continuous_texture.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace relief {
namespace {

// exp(-4^2 / 2) = 0.0003: below a step of 8 bits.
constexpr double kReach = 4.0;
// The largest half-precision value: nothing brighter can be written, and no sum overflows.
constexpr float kMax = 65504.0F;
constexpr std::size_t kMaxTaps =
    2 * static_cast<std::size_t>(kReach * ContinuousTexture::kLargestDeviation) + 2;

/// The texels along one axis that contribute to a position, with weights that sum to 1.
struct Taps {
  std::array<std::uint32_t, kMaxTaps> texel{};
  std::array<float, kMaxTaps> weight{};
  std::size_t count = 0;
};

/// `coordinate`: 0 to 1 across `size` texels.
Taps find_taps(double coordinate, std::uint32_t size, double deviation) {
  const double x = (coordinate - std::floor(coordinate)) * size - 0.5;
  const auto low = static_cast<std::int64_t>(std::ceil(x - kReach * deviation));
  const auto high = static_cast<std::int64_t>(std::floor(x + kReach * deviation));
  Taps taps;
  double sum = 0.0;
  for (std::int64_t i = low; i <= high; ++i) {
    const double distance = (static_cast<double>(i) - x) / deviation;
    const double weight = std::exp(-0.5 * distance * distance);
    const std::int64_t wrapped = i % std::int64_t{size};
    taps.texel[taps.count] =
        static_cast<std::uint32_t>(wrapped < 0 ? wrapped + std::int64_t{size} : wrapped);
    taps.weight[taps.count++] = static_cast<float>(weight);
    sum += weight;
  }
  for (std::size_t i = 0; i < taps.count; ++i) taps.weight[i] /= static_cast<float>(sum);
  return taps;
}

}  // namespace

Result<ContinuousTexture> ContinuousTexture::from_image(const Image& image) {
  ContinuousTexture texture;
  texture.width_ = image.width;
  texture.height_ = image.height;
  texture.texels_.resize(std::size_t{image.width} * image.height);
  if (texture.texels_.empty()) return make_error("the texture has no pixels");
  constexpr const char* kNames[] = {"R", "G", "B"};
  for (glm::length_t c = 0; c < 3; ++c) {
    const Channel* channel = image.find(kNames[c]);
    if (channel == nullptr) {
      return make_error("the texture has no channel {}; use one with R, G and B", kNames[c]);
    }
    for (std::size_t i = 0; i < texture.texels_.size(); ++i) {
      const float value = channel->values[i];
      texture.texels_[i][c] = std::isfinite(value) ? std::clamp(value, -kMax, kMax) : 0.0F;
    }
  }
  return texture;
}

glm::vec3 ContinuousTexture::at(glm::vec2 texcoord, double deviation) const {
  assert(deviation >= 1.0 && deviation <= kLargestDeviation);
  const Taps columns = find_taps(texcoord.x, width_, deviation);
  const Taps rows = find_taps(1.0 - static_cast<double>(texcoord.y), height_, deviation);
  glm::vec3 sum(0.0F);
  for (std::size_t j = 0; j < rows.count; ++j) {
    const glm::vec3* row = texels_.data() + std::size_t{rows.texel[j]} * width_;
    glm::vec3 row_sum(0.0F);
    for (std::size_t i = 0; i < columns.count; ++i) {
      row_sum += columns.weight[i] * row[columns.texel[i]];
    }
    sum += rows.weight[j] * row_sum;
  }
  return sum;
}

}  // namespace relief
