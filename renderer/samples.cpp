#include "renderer/samples.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <optional>

#include "common/octahedral.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

constexpr float kLowestView = 0.58F;  // tan 30 degrees

/// How far a splat may reach beyond its cell within its own plane, in cells; more would stick out
/// of the silhouette as hairs wherever a steep slope was resampled badly. Border splats reach as
/// far as that, over the notches between the ragged borders of two patches.
constexpr float kLargestReach = 0.5F;

/// Heights of a patch with two rings of holes around, so that nothing asks for the edge.
class PaddedHeights {
 public:
  explicit PaddedHeights(const Patch& patch)
      : stride_(std::size_t{patch.width} + 2 * kRings),
        heights_(stride_ * (std::size_t{patch.height} + 2 * kRings), kHole) {
    for (std::uint32_t j = 0; j < patch.height; ++j) {
      std::copy_n(patch.heights.begin() + static_cast<std::ptrdiff_t>(j) * patch.width, patch.width,
                  heights_.begin() + static_cast<std::ptrdiff_t>(index(0, j)));
    }
  }
  [[nodiscard]] std::size_t index(std::uint32_t i, std::uint32_t j) const {
    return (std::size_t{j} + kRings) * stride_ + i + kRings;
  }
  [[nodiscard]] std::size_t stride() const { return stride_; }
  [[nodiscard]] std::size_t size() const { return heights_.size(); }
  [[nodiscard]] std::int32_t operator[](std::size_t k) const { return heights_[k]; }
  [[nodiscard]] bool valid(std::size_t k) const { return heights_[k] != kHole; }

 private:
  static constexpr std::size_t kRings = 2;
  std::size_t stride_;
  std::vector<std::int32_t> heights_;
};

bool is_border(const PaddedHeights& heights, std::size_t k) {
  const std::size_t above = k - heights.stride();
  const std::size_t below = k + heights.stride();
  for (const std::size_t row : {above, k, below}) {
    if (!heights.valid(row - 1) || !heights.valid(row) || !heights.valid(row + 1)) return true;
  }
  return false;
}

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

struct Slopes {
  std::vector<glm::i8vec2> steps;  ///< by padded index
  float slope_step = 0.0F;
};

/// The slope that the normal map has at a node; nothing without a map or where it is too steep.
std::optional<glm::vec2> slope_of_normal(const Patch& patch, std::uint32_t i, std::uint32_t j) {
  const AttributeMap<glm::i16vec2>& map = patch.normals;
  if (map.empty()) return std::nullopt;
  const std::size_t texel = std::size_t{j} * map.scale * map.width + std::size_t{i} * map.scale;
  const glm::vec3 n = unit_from_snorm16(map.texels[texel]);
  if (n.z * shared::kSteepest < 1.0F) return std::nullopt;
  return glm::vec2(-n.x, -n.y) / n.z;
}

/// Slopes as signed bytes, in steps that the steepest of the patch fills.
Slopes find_slopes(const PaddedHeights& heights, const Patch& patch, float height_step) {
  std::vector<glm::vec2> slopes(heights.size(), glm::vec2(0.0F));
  float steepest = 0.0F;
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const std::size_t k = heights.index(i, j);
      if (!heights.valid(k)) continue;
      // Beside a hole the normal map knows more than a one-sided difference does.
      const auto painted = is_border(heights, k) ? slope_of_normal(patch, i, j) : std::nullopt;
      const glm::vec2 slope =
          painted ? *painted
                  : height_step * glm::vec2(slope_along(heights, k, 1, heights.stride()),
                                            slope_along(heights, k, heights.stride(), 1));
      slopes[k] = glm::clamp(slope, -shared::kSteepest, shared::kSteepest);
      steepest = std::max({steepest, std::abs(slopes[k].x), std::abs(slopes[k].y)});
    }
  }
  Slopes found;
  found.slope_step = steepest / 127.0F;
  found.steps.resize(heights.size(), glm::i8vec2(0));
  if (steepest == 0.0F) return found;
  for (std::size_t k = 0; k < slopes.size(); ++k) {
    found.steps[k] = glm::i8vec2(glm::round(slopes[k] / found.slope_step));
  }
  return found;
}

/// How far tangent planes part where neighbours meet, and the width class that closes it.
class SlitFinder {
 public:
  SlitFinder(const PaddedHeights& heights, const Slopes& slopes, float height_step)
      : heights_(heights), slopes_(slopes), height_step_(height_step) {}

  [[nodiscard]] std::uint32_t width_class(std::size_t k, bool border) const {
    float widest = 0.0F;
    for (const int dj : {-1, 1}) {
      widest = std::max(widest, slit(k, std::array{glm::ivec2(0, 0), glm::ivec2(0, dj)}));
      widest = std::max(widest, slit(k, std::array{glm::ivec2(0, 0), glm::ivec2(dj, 0)}));
      for (const int di : {-1, 1}) {
        widest = std::max(widest, slit(k, std::array{glm::ivec2(0, 0), glm::ivec2(di, 0),
                                                     glm::ivec2(0, dj), glm::ivec2(di, dj)}));
      }
    }
    const glm::vec2 slope = slopes_.slope_step * glm::vec2(slopes_.steps[k]);
    const float cosine = 1.0F / std::sqrt(1.0F + glm::dot(slope, slope));
    const float closing = widest * cosine / (2.0F * kLowestView);
    const float largest = kLargestReach * cosine;
    const float margin = border ? largest : std::min(closing, largest);
    std::uint32_t c = 0;
    while (c + 1 < std::size(shared::kMargins) && shared::kMargins[c] < margin - 1e-6F) ++c;
    return c;
  }

 private:
  /// Spread of the planes of the samples at `offsets` from k, in the middle between them (cells).
  template <std::size_t Count>
  [[nodiscard]] float slit(std::size_t k, const std::array<glm::ivec2, Count>& offsets) const {
    glm::vec2 middle(0.0F);
    for (const glm::ivec2 o : offsets) middle += glm::vec2(o) / static_cast<float>(Count);
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();
    for (const glm::ivec2 o : offsets) {
      const auto step = static_cast<std::ptrdiff_t>(heights_.stride()) * o.y + o.x;
      const std::size_t n = k + static_cast<std::size_t>(step);
      if (!heights_.valid(n)) continue;
      const float height =
          height_step_ * static_cast<float>(heights_[n] - heights_[k]) +
          slopes_.slope_step * glm::dot(glm::vec2(slopes_.steps[n]), middle - glm::vec2(o));
      low = std::min(low, height);
      high = std::max(high, height);
    }
    return high - low;
  }

  const PaddedHeights& heights_;
  const Slopes& slopes_;
  float height_step_;
};

/// A sphere about the box of all samples, wide enough for the corners of their splats.
void bound(PatchSamples& samples, const Patch& patch) {
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const std::int32_t h = patch.at(i, j);
      if (h == kHole) continue;
      const glm::dvec3 p(i, j, h * static_cast<double>(samples.height_step));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  const double half = 0.5 + shared::kMargins[std::size(shared::kMargins) - 1];
  const double steepest = 127.0 * samples.slope_step;
  // The disc that holds the splat's parallelogram, at a slope that is steepest along both axes.
  samples.widest_disc = std::sqrt(2.0 + 4.0 * steepest * steepest) * half;
  samples.centre = 0.5 * (low + high);
  samples.radius = 0.5 * glm::length(high - low) + samples.widest_disc;
}

}  // namespace

PatchSamples make_samples(const Patch& patch) {
  assert(patch.width <= kMaxPatchSide && patch.height <= kMaxPatchSide &&
         patch.heights.size() == std::size_t{patch.width} * patch.height &&
         "a patch as its type says");
  PatchSamples samples;
  samples.height_step = static_cast<float>(patch.height_step / patch.spacing);
  const PaddedHeights heights(patch);
  const Slopes slopes = find_slopes(heights, patch, samples.height_step);
  samples.slope_step = slopes.slope_step;
  const SlitFinder slits(heights, slopes, samples.height_step);
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const std::size_t k = heights.index(i, j);
      if (!heights.valid(k)) continue;
      const bool border = is_border(heights, k);
      const std::uint32_t width_class = slits.width_class(k, border);
      const glm::u8vec2 slope(slopes.steps[k]);
      samples.records.push_back(
          {i | (j << shared::kRowShift) | (width_class << shared::kClassShift) |
               (border ? shared::kBorderBit : 0U),
           static_cast<std::uint32_t>(heights[k]) | (std::uint32_t{slope.x} << 16U) |
               (std::uint32_t{slope.y} << 24U)});
    }
  }
  if (!samples.records.empty()) bound(samples, patch);
  return samples;
}

}  // namespace relief
