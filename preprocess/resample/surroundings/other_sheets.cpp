#include "preprocess/resample/surroundings/other_sheets.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

namespace relief {
namespace {

// Surroundings that support samples are no steeper than 60 degrees, unless the region's own are.
// This is the tangent of 61.
constexpr double kLeastRise = 1.8;

constexpr double kAnyDistance = std::numeric_limits<double>::infinity();

/// Whether a point continues the sheet of one of the region's own.
bool continues(const PatchPoints& points, std::uint32_t own, std::size_t p) {
  const glm::dvec3 d = points.positions[p] - points.positions[own];
  const double rise = std::max({kLeastRise, glm::length(slope_of(points.normals[own])),
                                glm::length(slope_of(points.normals[p]))});
  const double spacing = std::max(points.spacing[own], points.spacing[p]);
  return std::abs(d.z) <= rise * (glm::length(glm::dvec2(d)) + spacing);
}

template <class T>
void reorder(const std::vector<std::uint32_t>& order, std::size_t first, std::vector<T>& values) {
  std::vector<T> moved;
  moved.reserve(order.size());
  for (const std::uint32_t p : order) moved.push_back(values[p]);
  std::copy(moved.begin(), moved.end(), values.begin() + static_cast<std::ptrdiff_t>(first));
}

}  // namespace

void drop_other_sheets(const PointGrid& own, PatchPoints& points) {
  std::vector<std::uint32_t> order(points.supporting - points.own);
  std::iota(order.begin(), order.end(), static_cast<std::uint32_t>(points.own));
  const auto others = std::stable_partition(order.begin(), order.end(), [&](std::uint32_t p) {
    const glm::dvec3& at = points.positions[p];
    return continues(points, own.nearest(at.x, at.y, kAnyDistance), p);
  });
  if (others == order.end()) return;
  reorder(order, points.own, points.ids);
  reorder(order, points.own, points.positions);
  reorder(order, points.own, points.normals);
  reorder(order, points.own, points.spacing);
  points.supporting = points.own + static_cast<std::size_t>(others - order.begin());
}

}  // namespace relief
