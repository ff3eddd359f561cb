#include "renderer/splat_reach.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace relief {
namespace {

constexpr float kLowestView = 0.58F;  // tan 30 degrees

// Planes that part by less than this where neighbours are half-way, in cells, need no other place:
// the spike would be as small, and a place found from smaller steps would be that of the noise.
constexpr float kLeastStep = 0.1F;

// How much farther than to its own neighbour a splat goes for the sake of the rows beside it, and
// the largest margin, both in spacings along its plane. Spikes (pixels more than a spacing in front
// of the truth) and what shines through (smooth pixels more than two behind it), six views each of
// fandisk, Lucy and the Dragon: 0.3 and 0.5: 22,778, 143; 0.3 and 0.2: 19,227, 153; 0.1 and 0.2:
// 18,001, 175; 0 and 0.1: 16,297, 298.
constexpr float kLargestExtra = 0.3F;
constexpr float kLargestMargin = 0.2F;

}  // namespace

SplatReach::SplatReach(const PaddedHeights& heights, const SplatSlopes& slopes, float height_step)
    : heights_(heights),
      slopes_(slopes),
      height_step_(height_step),
      along_x_(heights.size()),
      along_y_(heights.size()) {
  const std::size_t stride = heights.stride();
  for (std::size_t k = 0; k + stride < heights.size(); ++k) {
    if (!heights.valid(k)) continue;
    along_x_[k] = meet(k, 1, 0);
    along_y_[k] = meet(k, stride, 1);
  }
}

SplatReach::Meeting SplatReach::meet(std::size_t k, std::size_t step, glm::length_t axis) const {
  if (!heights_.valid(k + step)) return {};
  const float rise = height_step_ * static_cast<float>(heights_[k + step] - heights_[k]);
  const float first = slopes_.at(k)[axis];
  const float second = slopes_.at(k + step)[axis];
  // The first plane is above the second by turn * t - lead at t from the first to the second.
  const float turn = first - second;
  const float lead = rise - second;
  const auto gap = [&](float t) { return turn * t - lead; };
  float place = 0.5F;
  if (std::abs(gap(0.5F)) > kLeastStep) {
    // The place nearest to the middle where they part by no more.
    const float target = std::copysign(kLeastStep, gap(0.5F));
    const float meeting = turn == 0.0F ? 0.5F : (target + lead) / turn;
    place = std::clamp(meeting, 0.0F, 1.0F);
    if (std::abs(gap(place)) >= std::abs(gap(0.5F))) place = 0.5F;
  }
  return {place, std::abs(gap(place)), true};
}

/// Spread of the planes of a cell's samples where its edges' meetings say that they meet (cells).
float SplatReach::corner_gap(std::size_t cell) const {
  const std::size_t stride = heights_.stride();
  const auto mean = [](const Meeting& a, const Meeting& b) {
    if (!a.exists) return b.place;
    return b.exists ? 0.5F * (a.place + b.place) : a.place;
  };
  const glm::vec2 middle(mean(along_x_[cell], along_x_[cell + stride]),
                         mean(along_y_[cell], along_y_[cell + 1]));
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();
  std::size_t base = cell;
  for (const auto& [offset, corner] :
       {std::pair{std::size_t{0}, glm::vec2(0, 0)}, std::pair{std::size_t{1}, glm::vec2(1, 0)},
        std::pair{stride, glm::vec2(0, 1)}, std::pair{stride + 1, glm::vec2(1, 1)}}) {
    const std::size_t n = cell + offset;
    if (!heights_.valid(n)) continue;
    if (!heights_.valid(base)) base = n;
    const float height = height_step_ * static_cast<float>(heights_[n] - heights_[base]) +
                         glm::dot(slopes_.at(n), middle - corner);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high > low ? high - low : 0.0F;
}

float SplatReach::toward(std::size_t k, glm::length_t axis, bool forward) const {
  const std::size_t stride = heights_.stride();
  const std::size_t step = axis == 0 ? 1 : stride;
  const std::size_t across = axis == 0 ? stride : 1;
  const std::vector<Meeting>& meetings = axis == 0 ? along_x_ : along_y_;
  const std::size_t edge = forward ? k : k - step;
  const glm::vec2 slope = slopes_.at(k);
  const float uphill = 1.0F / std::sqrt(1.0F + slope[axis] * slope[axis]);  // spacings to cells
  const float cosine = 1.0F / std::sqrt(1.0F + glm::dot(slope, slope));
  if (!meetings[edge].exists) return 0.5F * uphill;

  float farthest = 0.0F;
  for (const std::size_t e : {edge - across, edge, edge + across}) {
    if (meetings[e].exists)
      farthest = std::max(farthest, forward ? meetings[e].place : 1.0F - meetings[e].place);
  }
  const float own = forward ? meetings[edge].place : 1.0F - meetings[edge].place;
  farthest = std::min(farthest, own + kLargestExtra * uphill);
  const std::size_t cell = forward ? k : k - step;
  const float gap = std::max({meetings[edge].gap, corner_gap(cell), corner_gap(cell - across)});
  return farthest + std::min(gap * cosine / (2.0F * kLowestView), kLargestMargin * cosine);
}

glm::vec4 SplatReach::of(std::size_t k) const {
  return {toward(k, 0, false), toward(k, 0, true), toward(k, 1, false), toward(k, 1, true)};
}

}  // namespace relief
