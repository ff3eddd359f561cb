#include "preprocess/normals/crease_sides.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

namespace relief {
namespace {

constexpr double kMostSpread = 0.12;  // 7 degrees; round features fill the 25 that are let in
constexpr std::size_t kFewest = 3;
constexpr double kSideAngle = 0.4363;  // that of kCreaseSideCosine, in radians

}  // namespace

std::optional<CreaseSide> most_shown_side(std::span<const OrientedPoint> points,
                                          std::size_t fewest) {
  if (points.size() < fewest) return {};
  const OrientedPoint* best = nullptr;
  std::ptrdiff_t most = 0;
  for (const OrientedPoint& p : points) {
    const auto agreeing = std::ranges::count_if(points, [&](const OrientedPoint& q) {
      return glm::dot(p.normal, q.normal) >= kCreaseSideCosine;
    });
    if (agreeing <= most) continue;
    most = agreeing;
    best = &p;
  }
  if (most < static_cast<std::ptrdiff_t>(fewest)) return {};
  CreaseSide side;
  for (const OrientedPoint& p : points) {
    if (glm::dot(p.normal, best->normal) < kCreaseSideCosine) continue;
    side.middle += p.position;
    side.normal += p.normal;
  }
  // Of n unit vectors at small angles a about their mean, the sum has the length n (1 - a^2 / 2).
  const auto count = static_cast<double>(most);
  const double length = glm::length(side.normal);
  if (!(2.0 * (1.0 - length / count) <= kMostSpread * kMostSpread)) return {};
  side.middle /= count;
  side.normal /= static_cast<float>(length);
  return side;
}

std::optional<CreaseSide> farthest_side(std::span<const OrientedPoint> points, glm::vec3 normal) {
  if (points.size() < kFewest) return {};
  std::vector<float> cosines;
  cosines.reserve(points.size());
  for (const OrientedPoint& p : points) cosines.push_back(glm::dot(p.normal, normal));
  const auto farthest = cosines.begin() + (kFewest - 1);  // fewer make no side
  std::nth_element(cosines.begin(), farthest, cosines.end());
  const double angle = std::acos(std::clamp(double{*farthest}, -1.0, 1.0));
  const auto most = static_cast<float>(std::cos(std::max(angle - kSideAngle, 0.0)));
  std::vector<OrientedPoint> far;
  for (const OrientedPoint& p : points) {
    if (glm::dot(p.normal, normal) <= most) far.push_back(p);
  }
  return most_shown_side(far, kFewest);
}

}  // namespace relief
