#include "renderer/geometry/cells/levels.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <glm/ext/vector_int2_sized.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Slopes (height per cell, in cells) are continued beyond a border up to this, as splats lean.
constexpr double kSteepestContinued = shared::kSteepest;

/// Nodes of a level along a side of `nodes` nodes: one before the first, and one beyond the last.
std::uint32_t nodes_along(std::uint32_t nodes, std::uint32_t stride) {
  return (nodes - 1) / stride + 3;
}

/// The patch's column or row of a level's; may lie beyond it.
std::int64_t fine_of(std::uint32_t coarse, std::uint32_t stride) {
  return (static_cast<std::int64_t>(coarse) - 1) * stride;
}

/// Reads heights at any node; holes beyond the grid.
class Heights {
 public:
  explicit Heights(const Patch& patch) : patch_(patch) {}

  [[nodiscard]] std::int32_t at(glm::i64vec2 node) const {
    if (node.x < 0 || node.y < 0 || node.x >= patch_.width || node.y >= patch_.height) return kHole;
    return patch_.at(static_cast<std::uint32_t>(node.x), static_cast<std::uint32_t>(node.y));
  }

  /// The sample nearest to a node, of those within `reach` along both sides.
  [[nodiscard]] std::optional<glm::i64vec2> nearest(glm::i64vec2 node, std::int64_t reach) const {
    std::optional<glm::i64vec2> best;
    std::int64_t least = std::numeric_limits<std::int64_t>::max();
    for (std::int64_t y = -reach; y <= reach; ++y) {
      for (std::int64_t x = -reach; x <= reach; ++x) {
        const std::int64_t squared = x * x + y * y;
        if (squared >= least || at(node + glm::i64vec2(x, y)) == kHole) continue;
        least = squared;
        best = node + glm::i64vec2(x, y);
      }
    }
    return best;
  }

  /// The height index at a node without a sample, continued from `sample` through the sample as far
  /// on its other side.
  [[nodiscard]] double continued(glm::i64vec2 node, glm::i64vec2 sample) const {
    const auto height = static_cast<double>(at(sample));
    const glm::i64vec2 beyond = 2L * sample - node;
    if (at(beyond) == kHole) return height;
    const double rise = height - at(beyond);
    const double most = kSteepestContinued * patch_.spacing / patch_.height_step *
                        glm::length(glm::dvec2(node - sample));
    return std::abs(rise) <= most ? height + rise : height;
  }

  /// Whether all nodes from one on, `cells` cells along both sides, are samples.
  [[nodiscard]] bool all_samples(glm::i64vec2 first, std::int64_t cells) const {
    for (std::int64_t y = 0; y <= cells; ++y) {
      for (std::int64_t x = 0; x <= cells; ++x) {
        if (at(first + glm::i64vec2(x, y)) == kHole) return false;
      }
    }
    return true;
  }

 private:
  const Patch& patch_;
};

/// Normals at the level's nodes; those beyond the patch are its edge's.
AttributeMap<glm::i16vec2> coarsen_normals(const Patch& patch, std::uint32_t stride,
                                           std::uint32_t width, std::uint32_t height) {
  if (patch.normals.empty()) return {};
  const auto node_within = [stride](std::uint32_t coarse, std::uint32_t nodes) {
    return static_cast<std::size_t>(
        std::clamp<std::int64_t>(fine_of(coarse, stride), 0, std::int64_t{nodes} - 1));
  };
  AttributeMap<glm::i16vec2> normals{width, height, 1, {}};
  normals.texels.reserve(std::size_t{width} * height);
  for (std::uint32_t j = 0; j < height; ++j) {
    const std::size_t y = node_within(j, patch.height) * patch.normals.scale;
    for (std::uint32_t i = 0; i < width; ++i) {
      const std::size_t x = node_within(i, patch.width) * patch.normals.scale;
      normals.texels.push_back(patch.normals.texels[y * patch.normals.width + x]);
    }
  }
  return normals;
}

}  // namespace

std::optional<double> level_error(const Patch& patch, std::uint32_t level) {
  assert(level > 0 && level < kMaxLevels && "a coarser level of samples");
  const std::uint32_t stride = 1U << level;
  const double part = 1.0 / stride;
  double squares = 0.0;
  std::size_t samples = 0;
  for (std::uint32_t j = 0; j + stride < patch.height; j += stride) {
    for (std::uint32_t i = 0; i + stride < patch.width; i += stride) {
      const std::int32_t h00 = patch.at(i, j);
      const std::int32_t h10 = patch.at(i + stride, j);
      const std::int32_t h01 = patch.at(i, j + stride);
      const std::int32_t h11 = patch.at(i + stride, j + stride);
      if (h00 == kHole || h10 == kHole || h01 == kHole || h11 == kHole) continue;
      for (std::uint32_t y = 0; y < stride; ++y) {
        for (std::uint32_t x = 0; x < stride; ++x) {
          const std::int32_t height = patch.at(i + x, j + y);
          if (height == kHole) continue;
          const double u = part * x;
          const double v = part * y;
          // Halved along the diagonal from (0, 0), as cells are.
          const double level_height = u > v ? h00 + u * (h10 - h00) + v * (h11 - h10)
                                            : h00 + u * (h11 - h01) + v * (h01 - h00);
          squares += (height - level_height) * (height - level_height);
          ++samples;
        }
      }
    }
  }
  if (samples == 0) return std::nullopt;
  return patch.height_step * std::sqrt(squares / static_cast<double>(samples));
}

void measure_levels(const Patch& patch, std::uint32_t coarsest, PatchExtent& extent) {
  for (; extent.measured < coarsest; ++extent.measured) {
    const std::uint32_t level = extent.measured + 1;
    extent.errors[level] =
        level_error(patch, level)
            .value_or(level > 1 ? 4.0 * extent.errors[level - 1] : patch.spacing);
  }
}

PatchExtent extent_of(const Patch& patch) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::dvec3 p(i * patch.spacing, j * patch.spacing, patch.at(i, j) * patch.height_step);
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  PatchExtent extent;
  extent.spacing = patch.spacing;
  if (low.x > high.x) return extent;
  extent.centre = patch.origin + patch.axes * (0.5 * (low + high));
  extent.radius = 0.5 * glm::length(high - low);
  const std::uint32_t side = std::max(patch.width, patch.height) - 1;
  while (extent.levels < kMaxLevels && side >> extent.levels > 0) ++extent.levels;
  return extent;
}

std::uint32_t coarsest_level(const View& view, const PatchExtent& extent) {
  const double pixel = nearest_pixel(view, extent.centre, extent.radius);
  std::uint32_t level = 0;
  while (level + 1 < extent.levels &&
         std::ldexp(extent.spacing, static_cast<int>(level) + 1) <= view.pixels_per_sample * pixel)
    ++level;
  return level;
}

std::uint32_t choose_level(const View& view, const PatchExtent& extent) {
  std::uint32_t level = coarsest_level(view, extent);
  const double most =
      kMostLevelError * view.pixels_per_sample * nearest_pixel(view, extent.centre, extent.radius);
  while (level > 0 && extent.errors[level] > most) --level;
  return level;
}

std::vector<std::uint32_t> levels_in(std::span<const View> views, const PatchExtent& extent) {
  std::vector<std::uint32_t> levels;
  for (const View& view : views) levels.push_back(choose_level(view, extent));
  if (levels.empty()) levels.push_back(0);
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  return levels;
}

PatchLevel coarsen(const Patch& patch, std::uint32_t level) {
  assert(level > 0 && level < kMaxLevels && patch.width > 0 && patch.height > 0 &&
         "a coarser level of samples");
  const std::uint32_t stride = 1U << level;
  PatchLevel made;
  Patch& coarse = made.grid;
  coarse.axes = patch.axes;
  coarse.spacing = stride * patch.spacing;
  coarse.height_step = patch.height_step;
  coarse.material = patch.material;
  coarse.width = nodes_along(patch.width, stride);
  coarse.height = nodes_along(patch.height, stride);
  coarse.normals = coarsen_normals(patch, stride, coarse.width, coarse.height);

  const Heights heights(patch);
  coarse.heights.reserve(std::size_t{coarse.width} * coarse.height);
  made.whole.reserve(std::size_t{coarse.width} * coarse.height);
  std::int32_t lowest = 0;
  for (std::uint32_t j = 0; j < coarse.height; ++j) {
    for (std::uint32_t i = 0; i < coarse.width; ++i) {
      const glm::i64vec2 node(fine_of(i, stride), fine_of(j, stride));
      std::int32_t height = heights.at(node);
      if (height == kHole) {
        if (const auto sample = heights.nearest(node, stride))
          height = static_cast<std::int32_t>(std::lround(heights.continued(node, *sample)));
      }
      if (height != kHole) lowest = std::min(lowest, height);
      coarse.heights.push_back(height);
      made.whole.push_back(heights.all_samples(node, stride) ? 1 : 0);
    }
  }
  for (std::int32_t& height : coarse.heights) {
    if (height != kHole) height = std::min(height - lowest, kMaxHeightRange);
  }
  coarse.origin = patch.origin + patch.axes * glm::dvec3(-coarse.spacing, -coarse.spacing,
                                                         lowest * patch.height_step);
  return made;
}

}  // namespace relief
