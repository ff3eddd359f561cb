#include "renderer/geometry/cells/patch_border.h"

#include <algorithm>
#include <cmath>

#include "shaders/include/shared.h"

namespace relief {
namespace {

constexpr std::array<std::int32_t, 5> kWeights{1, 4, 6, 4, 1};
constexpr std::int32_t kRadius = 2;
constexpr float kWeightSum = 256.0F;

// A mean is at least this at a sample, so that corners are not cut off at it ...
constexpr float kLeastOfSample = 0.6F;
// ... or this, if it belongs to no whole cell: those of lines one sample wide reach as far as
// others.
constexpr float kLeastOfLine = 0.8F;
// The mean is at most this at a hole.
constexpr float kMostOfHole = 0.498F;

/// The corners of a cell, counterclockwise.
constexpr std::array<glm::i32vec2, 4> kCorners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

}  // namespace

bool PatchBorder::is_sample(glm::i32vec2 node) const {
  return node.x >= 0 && node.y >= 0 && static_cast<std::uint32_t>(node.x) < patch_.width &&
         static_cast<std::uint32_t>(node.y) < patch_.height &&
         patch_.at(static_cast<std::uint32_t>(node.x), static_cast<std::uint32_t>(node.y)) != kHole;
}

float PatchBorder::mean_at(glm::i32vec2 node) const {
  std::int32_t sum = 0;
  glm::i32vec2 other = node - kRadius;
  for (const std::int32_t row : kWeights) {
    other.x = node.x - kRadius;
    for (const std::int32_t column : kWeights) {
      if (is_sample(other)) sum += row * column;
      ++other.x;
    }
    ++other.y;
  }
  const float mean = static_cast<float>(sum) / kWeightSum;
  if (!is_sample(node)) return std::min(mean, kMostOfHole);
  return std::max(mean, has_cell(node) ? kLeastOfSample : kLeastOfLine);
}

glm::dvec3 PatchBorder::position_of(const BorderCorner& corner) const {
  const glm::i32vec2 step = corner.toward - corner.node;
  const double at = height(corner.node);
  double rise = 0.0;
  if (const glm::i32vec2 before = corner.node - step;
      step != glm::i32vec2(0) && is_sample(before)) {
    const double from_before = at - height(before);
    if (std::abs(from_before) <= shared::kSteepest) rise = from_before;
  }
  const double way = corner.way / std::sqrt(1.0 + rise * rise);
  return {glm::dvec2(corner.node) + way * glm::dvec2(step), at + way * rise};
}

bool PatchBorder::beside_jump(glm::i32vec2 node) const {
  return std::ranges::any_of(kCorners, [&](glm::i32vec2 corner) { return jumps(node - corner); });
}

std::uint32_t PatchBorder::samples_of(glm::i32vec2 cell) const {
  std::uint32_t samples = 0;
  for (std::size_t k = 0; k < kCorners.size(); ++k)
    samples |= is_sample(cell + kCorners[k]) ? 1U << k : 0U;
  return samples;
}

bool PatchBorder::jumps(glm::i32vec2 cell) const {
  for (std::size_t k = 0; k < kCorners.size(); ++k) {
    const glm::i32vec2 a = cell + kCorners[k];
    const glm::i32vec2 b = cell + kCorners[(k + 1) % 4];
    if (is_sample(a) && is_sample(b) && std::abs(height(a) - height(b)) > shared::kSteepest)
      return true;
  }
  return false;
}

bool PatchBorder::has_cell(glm::i32vec2 node) const {
  return std::ranges::any_of(
      kCorners, [&](glm::i32vec2 corner) { return samples_of(node - corner) == 0xFU; });
}

BorderPolygon PatchBorder::polygon(glm::i32vec2 cell, std::uint32_t samples) const {
  BorderPolygon made;
  const auto add = [&](std::size_t slot, const BorderCorner& corner) {
    made.slots = static_cast<std::uint8_t>(made.slots | (1U << slot));
    made.corners[made.count++] = corner;
  };
  for (std::size_t k = 0; k < kCorners.size(); ++k) {
    const std::size_t next = (k + 1) % 4;
    const glm::i32vec2 a = cell + kCorners[k];
    const glm::i32vec2 b = cell + kCorners[next];
    const bool from = ((samples >> k) & 1U) != 0;
    const bool to = ((samples >> next) & 1U) != 0;
    if (from) add(2 * k, {a, a, 0.0F});
    if (from != to) add(2 * k + 1, from ? crossing(a, b) : crossing(b, a));
  }
  return made;
}

BorderCorner PatchBorder::crossing(glm::i32vec2 sample, glm::i32vec2 hole) const {
  const float inside = mean_at(sample);
  const float outside = mean_at(hole);
  const float way = (inside - 0.5F) / (inside - outside);
  return {sample, hole, shared::kBorderStep * std::round(way / shared::kBorderStep)};
}

double PatchBorder::height(glm::i32vec2 node) const {
  return patch_.at(static_cast<std::uint32_t>(node.x), static_cast<std::uint32_t>(node.y)) *
         (patch_.height_step / patch_.spacing);
}

}  // namespace relief
