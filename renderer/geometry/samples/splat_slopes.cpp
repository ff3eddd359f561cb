#include "renderer/geometry/samples/splat_slopes.h"

#include <cmath>
#include <glm/common.hpp>

#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Sum of the differences of heights along one axis over the cells beside node k, and how many of
/// those cells have both ends.
struct Difference {
  float sum = 0.0F;
  float cells = 0.0F;
};

Difference difference(const PaddedHeights& heights, std::size_t k, std::size_t step) {
  if (!heights.valid(k)) return {};
  const bool before = heights.valid(k - step);
  const bool after = heights.valid(k + step);
  const std::int32_t high = after ? heights[k + step] : heights[k];
  const std::int32_t low = before ? heights[k - step] : heights[k];
  return {static_cast<float>(high - low), static_cast<float>(before) + static_cast<float>(after)};
}

/// Height indices per cell along one axis at a sample. A sample alone in its row (the tip of a
/// ragged border) takes the slope of the rows beside it: a level plane would stick out there.
float slope_along(const PaddedHeights& heights, std::size_t k, std::size_t step,
                  std::size_t across) {
  const Difference own = difference(heights, k, step);
  if (own.cells > 0.0F) return own.sum / own.cells;
  Difference beside;
  for (const std::size_t row : {k - across, k + across}) {
    for (const std::size_t node : {row - step, row, row + step}) {
      const Difference other = difference(heights, node, step);
      beside.sum += other.sum;
      beside.cells += other.cells;
    }
  }
  return beside.cells > 0.0F ? beside.sum / beside.cells : 0.0F;
}

}  // namespace

SplatSlopes find_slopes(const PaddedHeights& heights, const Patch& patch, float height_step) {
  std::vector<glm::vec2> slopes(heights.size(), glm::vec2(0.0F));
  float steepest = 0.0F;
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const std::size_t k = heights.index(i, j);
      if (!heights.valid(k)) continue;
      const glm::vec2 slope = height_step * glm::vec2(slope_along(heights, k, 1, heights.stride()),
                                                      slope_along(heights, k, heights.stride(), 1));
      slopes[k] = glm::clamp(slope, -shared::kSteepest, shared::kSteepest);
      steepest = std::max({steepest, std::abs(slopes[k].x), std::abs(slopes[k].y)});
    }
  }
  SplatSlopes found;
  found.slope_step = steepest / 127.0F;
  found.steps.resize(heights.size(), glm::i8vec2(0));
  if (steepest == 0.0F) return found;
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    found.steps[k] = glm::i8vec2(glm::round(slopes[k] / found.slope_step));
  }
  return found;
}

}  // namespace relief
