#include "renderer/view/texels_in_view.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <vector>

#include "common/bounds.h"
#include "common/image/srgb.h"
#include "common/octahedral.h"

namespace relief {
namespace {

/// A map whose texel (a, b) is the mean of those about texel (2 a, 2 b), which lies where it does;
/// their weights along each side are 1, 2 and 1.
template <class Texel, class Decode, class Encode>
AttributeMap<Texel> mean_map(const AttributeMap<Texel>& map, const Decode& decode,
                             const Encode& encode) {
  assert(map.scale % 2 == 0 && "texels over nodes stay there");
  AttributeMap<Texel> half{(map.width - 1) / 2 + 1, (map.height - 1) / 2 + 1, map.scale / 2, {}};
  half.texels.reserve(std::size_t{half.width} * half.height);
  const auto beside = [](std::uint32_t k, int step, std::uint32_t count) {
    return static_cast<std::uint32_t>(
        std::clamp(static_cast<std::int64_t>(k) + step, std::int64_t{0}, std::int64_t{count} - 1));
  };
  for (std::uint32_t b = 0; b < half.height; ++b) {
    for (std::uint32_t a = 0; a < half.width; ++a) {
      glm::vec3 sum(0.0F);
      for (int y = -1; y <= 1; ++y) {
        const std::size_t row = std::size_t{beside(2 * b, y, map.height)} * map.width;
        for (int x = -1; x <= 1; ++x) {
          const auto weight = static_cast<float>((2 - std::abs(x)) * (2 - std::abs(y)));
          sum += weight * decode(map.texels[row + beside(2 * a, x, map.width)]);
        }
      }
      const std::size_t middle = std::size_t{2} * b * map.width + std::size_t{2} * a;
      half.texels.push_back(encode(sum / 16.0F, map.texels[middle]));
    }
  }
  return half;
}

template <class Texel>
std::uint64_t bytes_of(const AttributeMap<Texel>& map) {
  return map.texels.size() * sizeof(Texel);
}

/// Halves a map as often as it may be. A cell is seen at most `pixels_per_cell` wide.
template <class Texel>
void halve_unseen(double pixels_per_cell, AttributeMap<Texel>& map) {
  while (!map.empty() && map.scale % 2 == 0 && pixels_per_cell <= kPixelsPerTexel * 0.5 * map.scale)
    map = halved(map);
}

Bounds box_of_samples(const Patch& patch) {
  Bounds box;
  for_each_position({&patch, 1}, [&box](const glm::dvec3& p) { extend(box, p); });
  return box;
}

}  // namespace

AttributeMap<glm::u8vec3> halved(const AttributeMap<glm::u8vec3>& colours) {
  return mean_map(
      colours, [](glm::u8vec3 texel) { return linear_from_srgb8(texel); },
      [](glm::vec3 mean, glm::u8vec3 /*middle*/) { return srgb8_from_linear(mean); });
}

AttributeMap<glm::i16vec2> halved(const AttributeMap<glm::i16vec2>& normals) {
  return mean_map(
      normals, [](glm::i16vec2 texel) { return unit_from_snorm16(texel); },
      [](glm::vec3 mean, glm::i16vec2 middle) {
        const float length = glm::length(mean);
        return length > 1e-3F ? snorm16_from_unit(mean / length) : middle;
      });
}

std::uint64_t drop_unseen_texels(std::span<const Onlooker> onlookers, std::span<Patch> patches,
                                 bool are_labels) {
  std::vector<Onlooker> near(onlookers.begin(), onlookers.end());
  for (Onlooker& onlooker : near) onlooker.pixels = 1.0;
  std::atomic<std::uint64_t> dropped{0};
  tbb::parallel_for(std::size_t{0}, patches.size(), [&](std::size_t p) {
    Patch& patch = patches[p];
    if (patch.colours.scale < 2 && patch.normals.scale < 2) return;
    const std::uint64_t before = bytes_of(patch.colours) + bytes_of(patch.normals);
    const double pixels = coarseness(near, box_of_samples(patch), patch.spacing);
    if (!are_labels) halve_unseen(pixels, patch.colours);
    halve_unseen(pixels, patch.normals);
    dropped += before - bytes_of(patch.colours) - bytes_of(patch.normals);
  });
  return dropped;
}

}  // namespace relief
