#include "preprocess/noise/rings.h"

#include <algorithm>
#include <cmath>

namespace relief {
namespace {

constexpr double kInnermost = 1.9;
constexpr double kGrowth = 1.5;  // of the squared radius
// Eleven rings of an evenly sampled plane have 650 points; noise as wide as the rings, four times
// as many.
constexpr std::size_t kMostNeighbours = 3000;

std::array<double, Rings::kCount> squared_radii() {
  std::array<double, Rings::kCount> squared{kInnermost * kInnermost};
  for (std::size_t r = 1; r < Rings::kCount; ++r) squared[r] = kGrowth * squared[r - 1];
  return squared;
}

const std::array<double, Rings::kCount> kSquaredRingRadii = squared_radii();

/// The ring of a squared distance within the last one's. Points are in all of them, in no order
/// that a processor could predict: all are compared.
std::uint8_t ring_at(double squared) {
  int ring = 0;
  for (const double radius : kSquaredRingRadii) ring += squared >= radius ? 1 : 0;
  return static_cast<std::uint8_t>(ring);
}

}  // namespace

double Rings::radius(std::size_t ring) {
  return std::sqrt(kSquaredRingRadii[ring]);
}
double Rings::squared_radius(std::size_t ring) {
  return kSquaredRingRadii[ring];
}

void Rings::collect(const glm::dvec3& centre, double unit, std::size_t rings) {
  for (count_ = rings; count_ > 0 && !collect_within(centre, unit, count_); --count_) {
  }
  sort_by_ring(count_);
}

bool Rings::collect_within(const glm::dvec3& centre, double unit, std::size_t rings) {
  found_.clear();
  ring_of_.clear();
  const double scale = 1.0 / (unit * unit);
  const double in_units = 1.0 / unit;
  const double squared_reach = kSquaredRingRadii[rings - 1];
  double reach = squared_reach * unit * unit;
  const auto look_at_leaf = [&](std::size_t first, std::size_t count) {
    std::array<double, PositionTree::kLeafSize> squared;
    tree_.squared_distances(centre, first, squared);
    for (std::size_t m = 0; m < count; ++m) {
      const double distance = squared[m] * scale;
      if (!(distance < squared_reach)) continue;
      found_.push_back(
          {(tree_.at(first + m) - centre) * in_units, static_cast<std::uint32_t>(first + m)});
      ring_of_.push_back(ring_at(distance));
    }
    if (found_.size() > kMostNeighbours) reach = -1.0;
  };
  tree_.visit_near(
      centre, [&reach] { return reach; }, look_at_leaf);
  return found_.size() <= kMostNeighbours;
}

void Rings::sort_by_ring(std::size_t rings) {
  ends_.fill(0);
  if (rings == 0) return neighbours_.clear();
  for (const std::uint8_t ring : ring_of_) ++ends_[ring + 1];
  for (std::size_t r = 0; r < kCount; ++r) ends_[r + 1] += ends_[r];
  std::array<std::size_t, kCount + 1> next = ends_;
  neighbours_.resize(found_.size());
  for (std::size_t i = 0; i < found_.size(); ++i) neighbours_[next[ring_of_[i]]++] = found_[i];
}

}  // namespace relief
