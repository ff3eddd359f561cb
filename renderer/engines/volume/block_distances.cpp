#include "renderer/engines/volume/block_distances.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

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

std::vector<std::uint8_t> sheet_distances(std::span<const glm::u16vec4> texels, glm::uvec3 size,
                                          glm::uvec3 axes) {
  constexpr std::uint32_t kSquare = shared::kVolumeSheetBlock;
  const std::array<std::size_t, 3> strides{1, size.x, std::size_t{size.x} * size.y};
  const auto length = [&](std::uint32_t axis) { return size[static_cast<glm::length_t>(axis)]; };
  const std::size_t row = (length(axes.x) - 1) / kSquare + 1;
  const std::size_t rows = (length(axes.y) - 1) / kSquare + 1;
  std::vector<std::uint8_t> distances(row * rows * length(axes.z), kMostSheetDistance);
  tbb::parallel_for(std::uint32_t{0}, length(axes.z), [&](std::uint32_t w) {
    std::uint8_t* const own = distances.data() + row * rows * w;
    for (std::uint32_t v = 0; v < length(axes.y); ++v) {
      for (std::uint32_t u = 0; u < length(axes.x); ++u) {
        if (texels[u * strides[axes.x] + v * strides[axes.y] + w * strides[axes.z]].w != 0)
          own[u / kSquare + row * (v / kSquare)] = 0;
      }
    }
    std::vector<std::uint8_t> line;
    for (std::size_t y = 0; y < rows; ++y) spread(own + y * row, row, 1, line);
    for (std::size_t x = 0; x < row; ++x) spread(own + x, rows, row, line);
  });
  return distances;
}

}  // namespace relief::volume
