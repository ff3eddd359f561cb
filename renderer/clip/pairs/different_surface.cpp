#include "renderer/clip/pairs/different_surface.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "common/median.h"
#include "renderer/clip/pairs/slot_pieces.h"

namespace relief {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kLeastAngle = 30.0 * kDegree;
constexpr double kMostAngle = 60.0 * kDegree;
constexpr double kOfNoise = 7.0;
/// More is an edge that most neighbours are beyond, or as bad as no normals.
constexpr double kMostNoise = kMostAngle / kOfNoise;
/// Planes within half the threshold are parallel, but no more than this: sharper blades have no
/// edge.
constexpr double kMostWallAngle = 15.0 * kDegree;
/// Neighbours that the noise is measured on: the nearest ones.
constexpr std::size_t kMeasured = 48;

/// What a thread needs anew for each disc.
struct Measured {
  std::vector<std::uint32_t> neighbours;
  std::vector<double> values;
};

/// The angle that a fifth of the neighbours' normals stay below; 0 without neighbours.
double noise_at(const DiscTree& tree, std::size_t slot, Measured& measured) {
  auto& [neighbours, cosines] = measured;
  neighbours.clear();
  cosines.clear();
  tree.neighbours(slot, kMeasured, neighbours);
  if (neighbours.empty()) return 0.0;
  for (const std::uint32_t other : neighbours)
    cosines.push_back(glm::dot(tree.discs()[slot].normal, tree.discs()[other].normal));
  const auto fifth = cosines.begin() + static_cast<std::ptrdiff_t>(cosines.size() / 5);
  std::nth_element(cosines.begin(), fifth, cosines.end(), std::greater<>());
  return std::min(std::acos(std::clamp(*fifth, -1.0, 1.0)), kMostNoise);
}

/// The angle that makes a surface another one for a disc. Next to a tip the disc's own noise is the
/// turn of faces: that of most neighbours is less.
double threshold_at(const DiscTree& tree, std::size_t slot, const std::vector<float>& noise,
                    Measured& measured) {
  double least = double{noise[slot]};
  if (kOfNoise * least <= kLeastAngle) return kLeastAngle;
  auto& [neighbours, values] = measured;
  neighbours.clear();
  values.clear();
  tree.neighbours(slot, kMeasured, neighbours);
  for (const std::uint32_t other : neighbours) values.push_back(double{noise[other]});
  least = std::min(least, median_of(values));
  return std::max(kOfNoise * least, kLeastAngle);
}

}  // namespace

SurfaceTest::SurfaceTest(const DiscTree& tree, std::optional<double> threshold) {
  const std::size_t count = tree.discs().size();
  const auto for_slots = [&](const auto& work) {
    for_pieces(count, [&](std::size_t /*piece*/, std::size_t begin, std::size_t end) {
      Measured measured;
      for (std::size_t slot = begin; slot < end; ++slot) work(slot, measured);
    });
  };
  noise_.resize(count);
  for_slots([&](std::size_t slot, Measured& measured) {
    noise_[slot] = static_cast<float>(noise_at(tree, slot, measured));
  });
  if (threshold) {
    limits_.push_back(limits_of(std::acos(std::clamp(*threshold, -1.0, 1.0))));
    return;
  }
  limits_.resize(count);
  for_slots([&](std::size_t slot, Measured& measured) {
    limits_[slot] = limits_of(threshold_at(tree, slot, noise_, measured));
  });
}

SurfaceTest::Limits SurfaceTest::limits_of(double angle) {
  const double sine = std::sin(std::min(0.5 * angle, kMostWallAngle));
  return {std::cos(angle), sine * sine};
}

bool SurfaceTest::differ(const DiscTree& tree, std::size_t slot, std::size_t other) const {
  const glm::dvec3 a = tree.discs()[slot].normal;
  const glm::dvec3 b = tree.discs()[other].normal;
  if (!(glm::dot(a, b) < std::min(of(slot).cosine, of(other).cosine))) return false;
  // The sine from the cross product: 1 - cosine^2 has few digits left where it matters.
  const glm::dvec3 cross = glm::cross(a, b);
  return glm::dot(cross, cross) > std::max(of(slot).squared_sine, of(other).squared_sine);
}

double SurfaceTest::threshold() const {
  if (limits_.empty()) return -1.0;
  std::vector<double> cosines;
  for (const Limits& limits : limits_) cosines.push_back(limits.cosine);
  return median_of(std::move(cosines));
}

}  // namespace relief
