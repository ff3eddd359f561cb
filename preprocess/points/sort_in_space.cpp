#include "preprocess/points/sort_in_space.h"

#include <tbb/parallel_for.h>

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

#include "common/bounds.h"
#include "common/mesh/triangle_order.h"
#include "common/neighbours/morton.h"
#include "preprocess/frame/working_frame.h"
#include "preprocess/frame/working_unit.h"

namespace relief {
namespace {

using Order = std::vector<std::uint32_t>;

/// `values` may be empty.
template <class T>
void sort_by(const Order& order, std::vector<T>& values) {
  if (values.empty()) return;
  std::vector<T> sorted(values.size());
  tbb::parallel_for(std::size_t{0}, order.size(),
                    [&](std::size_t k) { sorted[k] = values[order[k]]; });
  values = std::move(sorted);
}

/// Positions in the scan's own frame, rounded: however the scan lies, and in whatever order its
/// points come, they are in the same cells of the curve.
std::vector<glm::dvec3> in_own_frame(const std::vector<glm::dvec3>& positions) {
  const WorkingFrame frame = working_frame(positions);
  std::vector<glm::dvec3> own(positions.size());
  const auto for_each = [&own](const auto& fn) {
    tbb::parallel_for(std::size_t{0}, own.size(), fn);
  };
  for_each([&](std::size_t i) { own[i] = to_working_frame(frame, positions[i]); });
  const Bounds bounds = bounds_of(own);
  const double unit = power_of_two_below(glm::distance(bounds.min, bounds.max));
  for_each([&](std::size_t i) { own[i] = on_steps(own[i], unit); });
  return own;
}

Order order_in_space(const std::vector<glm::dvec3>& positions) {
  const std::vector<glm::dvec3> own = in_own_frame(positions);
  const Bounds bounds = bounds_of(own);
  std::vector<std::uint64_t> codes(own.size());
  tbb::parallel_for(std::size_t{0}, codes.size(),
                    [&](std::size_t i) { codes[i] = morton_code(own[i], bounds); });
  return order_of(codes);
}

void renumber(const Order& order, std::vector<Triangle>& triangles) {
  const Order places = places_in(order);
  tbb::parallel_for(std::size_t{0}, triangles.size(), [&](std::size_t t) {
    for (std::uint32_t& corner : triangles[t]) corner = places[corner];
  });
}

}  // namespace

std::vector<std::uint32_t> sort_in_space(Points& points) {
  Order order = order_in_space(points.positions);
  sort_by(order, points.positions);
  sort_by(order, points.normals);
  sort_by(order, points.colours);
  sort_by(order, points.texcoords);
  sort_by(order, points.scanner_of);
  for (PointScalar& scalar : points.scalars) sort_by(order, scalar.values);
  if (points.triangles.empty()) return order;
  renumber(order, points.triangles);
  const Order by_corner = order_triangles(points.triangles, points.size()).triangles;
  sort_by(by_corner, points.triangles);
  sort_by(by_corner, points.corner_texcoords);
  sort_by(by_corner, points.corner_tangents);
  sort_by(by_corner, points.triangle_materials);
  return order;
}

}  // namespace relief
