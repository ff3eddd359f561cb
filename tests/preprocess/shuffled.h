// A scan whose points and triangles are listed in another order.
#pragma once

#include <algorithm>
#include <numeric>
#include <random>

#include "common/points.h"

namespace relief::test {

/// Returns the same points and triangles, with their attributes, in an order by chance.
inline Points shuffled(const Points& points, unsigned seed) {
  std::mt19937 random(seed);
  const auto order_of = [&random](std::size_t count) {
    std::vector<std::uint32_t> order(count);
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::shuffle(order, random);
    return order;
  };
  const auto take = [](const std::vector<std::uint32_t>& order, auto& values) {
    auto taken = values;
    for (std::size_t k = 0; k < values.size(); ++k) taken[k] = values[order[k]];
    values = std::move(taken);
  };
  Points other = points;
  const std::vector<std::uint32_t> order = order_of(points.size());
  take(order, other.positions);
  take(order, other.normals);
  take(order, other.colours);
  take(order, other.texcoords);
  take(order, other.scanner_of);
  for (PointScalar& scalar : other.scalars) take(order, scalar.values);
  std::vector<std::uint32_t> places(points.size());
  for (std::uint32_t k = 0; k < order.size(); ++k) places[order[k]] = k;
  for (Triangle& t : other.triangles) {
    for (std::uint32_t& corner : t) corner = places[corner];
  }
  const std::vector<std::uint32_t> turns = order_of(points.triangles.size());
  take(turns, other.triangles);
  take(turns, other.corner_texcoords);
  take(turns, other.corner_tangents);
  take(turns, other.triangle_materials);
  return other;
}

}  // namespace relief::test
