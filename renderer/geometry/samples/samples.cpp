#include "renderer/geometry/samples/samples.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>
#include <limits>

#include "renderer/geometry/samples/padded_heights.h"
#include "renderer/geometry/samples/splat_reach.h"
#include "renderer/geometry/samples/splat_slopes.h"
#include "shaders/include/shared.h"

namespace relief {
namespace {

/// Four lengths as bytes, rounded up.
std::uint32_t pack_bytes(glm::vec4 lengths, float step) {
  std::uint32_t packed = 0;
  for (glm::length_t c = 0; c < 4; ++c) {
    const float steps = std::clamp(std::ceil(lengths[c] / step), 0.0F, 255.0F);
    packed |= static_cast<std::uint32_t>(steps) << (8 * c);
  }
  return packed;
}

/// The radius that a splat's disc (splats.glsl: splat_radius) or parallelogram may have in any
/// view, in cells.
double largest_radius(glm::dvec2 slope, const SampleRecord& record) {
  const double steepness = glm::dot(slope, slope);
  const double of_paper = std::sqrt(0.5) / (0.1 + 0.9 / std::sqrt(1.0 + steepness));
  return std::max(of_paper, covering_radius(record, slope));
}

}  // namespace

double covering_radius(const SampleRecord& record, glm::dvec2 slope) {
  const double largest_margin = shared::kLargestMargin / std::sqrt(1.0 + glm::dot(slope, slope));
  double radius = 0.0;
  const auto side = [&](int c) {
    const double reach = shared::kReachStep * ((record.reach >> (8 * c)) & 0xFFU);
    const double gap = shared::kGapStep * ((record.gap >> (8 * c)) & 0xFFU);
    return reach + std::min(0.5 * gap / shared::kLowestView, largest_margin);
  };
  for (const double x : {-side(0), side(1)}) {
    for (const double y : {-side(2), side(3)})
      radius = std::max(radius, glm::length(glm::dvec3(x, y, x * slope.x + y * slope.y)));
  }
  return radius;
}

PatchSamples make_samples(const Patch& patch, float to_hole) {
  assert(patch.width <= kMaxPatchSide && patch.height <= kMaxPatchSide &&
         patch.heights.size() == std::size_t{patch.width} * patch.height &&
         "a patch as its type says");
  PatchSamples samples;
  samples.height_step = static_cast<float>(patch.height_step / patch.spacing);
  const PaddedHeights heights(patch);
  const SplatSlopes slopes = find_slopes(heights, patch, samples.height_step);
  samples.slope_step = slopes.slope_step;
  const std::vector<SplatReach> reaches =
      find_reaches(heights, slopes, samples.height_step, to_hole);
  // Patches of large scans have up to a million; a list that grows would take twice as much.
  samples.records.reserve(count_samples(patch));
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      const std::size_t k = heights.index(i, j);
      if (!heights.valid(k)) continue;
      const glm::u8vec2 slope(slopes.steps[k]);
      // Reaches are rounded up so that nothing opens; half a step of a gap is what rounded slopes
      // and heights make.
      samples.records.push_back(
          {i | (j << shared::kRowShift) | (is_border(heights, k) ? shared::kBorderBit : 0U),
           static_cast<std::uint32_t>(heights[k]) | (std::uint32_t{slope.x} << 16U) |
               (std::uint32_t{slope.y} << 24U),
           pack_bytes(reaches[k].reach + shared::kMinMargin, shared::kReachStep),
           pack_bytes(reaches[k].gap - 0.5F * shared::kGapStep, shared::kGapStep)});
      samples.widest_disc = std::max(
          samples.widest_disc, largest_radius(glm::dvec2(slopes.at(k)), samples.records.back()));
    }
  }
  const PatchSamples bounds = bound_samples(patch);
  samples.centre = bounds.centre;
  if (!samples.records.empty()) samples.radius = bounds.radius + samples.widest_disc;
  return samples;
}

PatchSamples bound_samples(const Patch& patch) {
  PatchSamples samples;
  samples.height_step = static_cast<float>(patch.height_step / patch.spacing);
  glm::dvec3 low(std::numeric_limits<double>::max());
  glm::dvec3 high(std::numeric_limits<double>::lowest());
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i) {
      if (patch.at(i, j) == kHole) continue;
      const glm::dvec3 p(i, j, patch.at(i, j) * static_cast<double>(samples.height_step));
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  if (low.x > high.x) return samples;
  samples.centre = 0.5 * (low + high);
  samples.radius = 0.5 * glm::length(high - low);
  return samples;
}

}  // namespace relief
