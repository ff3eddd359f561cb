#include "renderer/engines/volume/block_distances.h"

#include <algorithm>

#include "shaders/volume/layout.h"

namespace relief::volume {
namespace {

constexpr std::uint32_t kSide = shared::kVolumeBlock;

/// Distances along one line, from those that the cells on it have: the larger of the two counts.
void spread(std::uint8_t* first, std::size_t count, std::size_t stride,
            std::vector<std::uint8_t>& line) {
  line.resize(count);
  for (std::size_t i = 0; i < count; ++i) line[i] = first[i * stride];
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t least = line[i];
    // Nearer cells than the best so far are worth a look; empty space is looked at in full.
    for (std::size_t off = 1; off < least; ++off) {
      if (i >= off) least = std::min(least, std::max(line[i - off], std::uint8_t(off)));
      if (i + off < count) least = std::min(least, std::max(line[i + off], std::uint8_t(off)));
    }
    first[i * stride] = least;
  }
}

}  // namespace

std::vector<std::uint8_t> block_distances(std::span<const glm::u16vec4> texels, glm::uvec3 size) {
  const glm::uvec3 blocks = (size - 1U) / kSide + 1U;
  const std::size_t row = blocks.x;
  const std::size_t plane = row * blocks.y;
  std::vector<std::uint8_t> distances(plane * blocks.z, 255);
  std::size_t texel = 0;
  for (std::uint32_t z = 0; z < size.z; ++z) {
    for (std::uint32_t y = 0; y < size.y; ++y) {
      for (std::uint32_t x = 0; x < size.x; ++x, ++texel) {
        if (texels[texel].w != 0)
          distances[x / kSide + row * (y / kSide) + plane * (z / kSide)] = 0;
      }
    }
  }
  std::vector<std::uint8_t> line;
  for (std::size_t k = 0; k < std::size_t{blocks.y} * blocks.z; ++k)
    spread(distances.data() + k * row, blocks.x, 1, line);
  for (std::size_t z = 0; z < blocks.z; ++z) {
    for (std::size_t x = 0; x < blocks.x; ++x)
      spread(distances.data() + z * plane + x, blocks.y, row, line);
  }
  for (std::size_t k = 0; k < plane; ++k) spread(distances.data() + k, blocks.z, plane, line);
  return distances;
}

}  // namespace relief::volume
