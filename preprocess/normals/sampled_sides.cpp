#include "preprocess/normals/sampled_sides.h"

#include <array>
#include <limits>

namespace relief {
namespace {

/// The n-th of a series of numbers that look random (splitmix64).
std::uint64_t lot_of(std::uint64_t n) {
  std::uint64_t z = (n + 1) * 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

}  // namespace

void ChanceSample::add(glm::dvec3 point) {
  const std::uint64_t lot = lot_of(seen_++);
  if ((lot & mask_) != 0) return;
  chosen_.push_back({lot, point});
  if (chosen_.size() < kMost) return;
  mask_ = mask_ << 1U | 1U;
  std::erase_if(chosen_, [this](const Chosen& c) { return (c.lot & mask_) != 0; });
}

std::vector<glm::dvec3> ChanceSample::take() {
  std::vector<glm::dvec3> points;
  points.reserve(chosen_.size());
  for (const Chosen& c : chosen_) points.push_back(c.point);
  chosen_ = {};
  return points;
}

glm::vec3 SampledSides::normal_near(glm::dvec3 position) const {
  double nearest = std::numeric_limits<double>::infinity();
  std::uint32_t found = 0;
  tree_.visit_near(
      position, [&nearest] { return nearest; },
      [&](std::size_t first, std::size_t count) {
        std::array<double, PositionTree::kLeafSize> squared;
        tree_.squared_distances(position, first, squared);
        for (std::size_t m = 0; m < count; ++m) {
          if (squared[m] >= nearest) continue;
          nearest = squared[m];
          found = tree_.index(first + m);
        }
      });
  return normals_[found];
}

}  // namespace relief
