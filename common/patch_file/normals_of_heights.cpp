#include "common/patch_file/normals_of_heights.h"

#include <cmath>

namespace relief {
namespace {

/// Height indices per cell at node (i, j) along `stride` (1: along a row of `count` nodes): central
/// differences in the node's own line and in those beside it, weighted 2 and 1 (Sobel); one-sided
/// where its own line has no more; 0 on its own.
double slope(const std::int32_t* node, std::size_t at, std::size_t count, std::ptrdiff_t stride,
             std::size_t line, std::size_t lines, std::ptrdiff_t line_stride) {
  const bool before = at > 0;
  const bool after = at + 1 < count;
  std::int32_t sum = 0;
  std::int32_t weight = 0;
  if (before && after) {
    for (std::ptrdiff_t beside = -1; beside <= 1; ++beside) {
      if ((beside < 0 && line == 0) || (beside > 0 && line + 1 == lines)) continue;
      const std::int32_t low = node[beside * line_stride - stride];
      const std::int32_t high = node[beside * line_stride + stride];
      if (low == kHole || high == kHole) continue;
      const std::int32_t w = beside == 0 ? 2 : 1;
      sum += w * (high - low);
      weight += 2 * w;
    }
  }
  if (weight > 0) return static_cast<double>(sum) / weight;
  if (after && node[stride] != kHole) return node[stride] - *node;
  if (before && node[-stride] != kHole) return *node - node[-stride];
  return 0.0;
}

}  // namespace

std::vector<glm::i16vec2> normals_of_heights(const Patch& patch, std::int32_t step) {
  const auto width = static_cast<std::ptrdiff_t>(patch.width);
  const double steps_per_cell = patch.spacing / patch.height_step;
  std::vector<glm::i16vec2> normals(patch.heights.size(), glm::i16vec2(0));
  std::size_t k = 0;
  for (std::size_t j = 0; j < patch.height; ++j) {
    for (std::size_t i = 0; i < patch.width; ++i, ++k) {
      if (patch.heights[k] == kHole) continue;
      const std::int32_t* node = &patch.heights[k];
      const double x = slope(node, i, patch.width, 1, j, patch.height, width);
      const double y = slope(node, j, patch.height, width, i, patch.width, 1);
      const double length = (std::abs(x) + std::abs(y) + steps_per_cell) * step;
      normals[k] = {static_cast<std::int16_t>(std::floor(-x * 32767.0 / length + 0.5)),
                    static_cast<std::int16_t>(std::floor(-y * 32767.0 / length + 0.5))};
    }
  }
  return normals;
}

}  // namespace relief
