// Distances to the nearest kernel, in blocks of a grid and in squares of its sheets.
#include "renderer/engines/volume/block_distances.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "shaders/volume/layout.h"

namespace relief::volume {
namespace {

TEST(SheetDistances, CountSquaresOfTheSheetAlone) {
  const glm::uvec3 size(9, 7, 5);
  std::vector<glm::u16vec4> texels(std::size_t{9} * 7 * 5, glm::u16vec4(0));
  texels[4 + 9 * (3 + 7 * 2)].w = 1;  // node (4, 3, 2)
  const std::uint32_t side = shared::kVolumeSheetBlock;
  for (const glm::uvec3 axes : {glm::uvec3(1, 2, 0), {2, 0, 1}, {0, 1, 2}}) {
    const auto of = [&](glm::uvec3 node) {
      return glm::uvec3(node[static_cast<glm::length_t>(axes.x)],
                        node[static_cast<glm::length_t>(axes.y)],
                        node[static_cast<glm::length_t>(axes.z)]);
    };
    const glm::uvec3 length = of(size);
    const glm::uvec3 used = of({4, 3, 2});
    const std::uint32_t row = (length.x - 1) / side + 1;
    const std::uint32_t rows = (length.y - 1) / side + 1;
    const auto distances = sheet_distances(texels, size, axes);
    ASSERT_EQ(distances.size(), row * rows * length.z);
    for (std::uint32_t w = 0; w < length.z; ++w) {
      for (std::uint32_t v = 0; v < rows; ++v) {
        for (std::uint32_t u = 0; u < row; ++u) {
          const auto off = [&](std::uint32_t a, std::uint32_t b) { return a > b ? a - b : b - a; };
          const std::uint32_t expected =
              w == used.z ? std::max(off(u, used.x / side), off(v, used.y / side))
                          : kMostSheetDistance;
          EXPECT_EQ(distances[u + row * (v + rows * w)], expected) << u << " " << v << " " << w;
        }
      }
    }
  }
}

}  // namespace
}  // namespace relief::volume
