#include "preprocess/partition/normal_spread.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace relief {
namespace {

/// Spread evenly over the sphere, along a spiral.
template <std::size_t N>
std::array<glm::vec3, N> even_directions() {
  std::array<glm::vec3, N> directions;
  constexpr double golden_angle = std::numbers::pi * (3.0 - 2.2360679774997896964);
  for (std::size_t d = 0; d < N; ++d) {
    const double z = 1.0 - (2.0 * static_cast<double>(d) + 1.0) / N;
    const double r = std::sqrt(1.0 - z * z);
    const double angle = golden_angle * static_cast<double>(d);
    directions[d] = glm::vec3(r * std::cos(angle), r * std::sin(angle), z);
  }
  return directions;
}

/// Normals and axes are unit to single precision, and so are the dots that RegionTest takes.
constexpr double kRounding = 1e-5;
/// Number of normals of a set that are used: 64 products each.
constexpr std::size_t kMaxNormals = 256;
/// Most sets are decided within ten steps; the limit is for borderline sets.
constexpr int kMaxSteps = 32;

}  // namespace

NormalSpread::NormalSpread(const std::vector<glm::vec3>& normals,
                           std::span<const std::uint32_t> points) {
  static const std::array<glm::vec3, kDirections> directions = even_directions<kDirections>();
  std::array<float, kDirections> farthest;
  farthest.fill(-2.0F);
  std::array<std::uint32_t, kDirections> which;
  which.fill(points.front());
  const std::size_t step = (points.size() + kMaxNormals - 1) / kMaxNormals;
  for (std::size_t p = 0; p < points.size(); p += step) {
    const std::uint32_t i = points[p];
    const glm::vec3 n = normals[i];
    for (std::size_t d = 0; d < kDirections; ++d) {
      const float along = glm::dot(n, directions[d]);
      which[d] = along > farthest[d] ? i : which[d];
      farthest[d] = std::max(along, farthest[d]);
    }
  }
  for (std::size_t d = 0; d < kDirections; ++d) outermost_[d] = normals[which[d]];
}

void NormalSpread::add(const NormalSpread& other) {
  static const std::array<glm::vec3, kDirections> directions = even_directions<kDirections>();
  for (std::size_t d = 0; d < kDirections; ++d) {
    if (glm::dot(other.outermost_[d], directions[d]) > glm::dot(outermost_[d], directions[d]))
      outermost_[d] = other.outermost_[d];
  }
}

// The cosine of the narrowest cone about unit vectors is the length of the shortest vector in their
// convex hull, so that any vector of the hull shorter than the wanted cosine proves that no such
// cone exists. Gilbert's steps (1966) towards the shortest one.
bool NormalSpread::exceed(const NormalSpread& a, const NormalSpread& b, double cos_cone) {
  const double certain = cos_cone - kRounding;
  if (certain <= 0.0) return false;
  glm::dvec3 in_hull(a.outermost_[0]);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double squared = glm::dot(in_hull, in_hull);
    if (squared < certain * certain) return true;
    glm::dvec3 worst(0.0);
    double smallest = 2.0;
    for (const NormalSpread* set : {&a, &b}) {
      for (const glm::vec3 n : set->outermost_) {
        const double along = glm::dot(in_hull, glm::dvec3(n));
        if (along >= smallest) continue;
        smallest = along;
        worst = n;
      }
    }
    if (smallest >= cos_cone * std::sqrt(squared)) return false;  // this axis holds them
    const glm::dvec3 change = worst - in_hull;
    in_hull += std::clamp(-glm::dot(in_hull, change) / glm::dot(change, change), 0.0, 1.0) * change;
  }
  return false;
}

}  // namespace relief
