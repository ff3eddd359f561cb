#include "common/mesh/triangle_order.h"

#include <tbb/parallel_for.h>

#include <numeric>
#include <tuple>

namespace relief {
namespace {

Triangle sorted(Triangle t) {
  std::ranges::sort(t);
  return t;
}

}  // namespace

TriangleOrder order_triangles(std::span<const Triangle> triangles, std::size_t points,
                              std::span<const std::uint8_t> left_out) {
  TriangleOrder order;
  order.ends.assign(points + 1, 0);
  const auto for_each = [&](const auto& fn) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (left_out.empty() || left_out[t] == 0) fn(t, *std::ranges::min_element(triangles[t]));
    }
  };
  for_each([&](std::uint32_t, std::uint32_t corner) { ++order.ends[corner + 1]; });
  std::partial_sum(order.ends.begin(), order.ends.end(), order.ends.begin());
  order.triangles.resize(order.ends.back());
  // Each corner's begin becomes its end.
  for_each(
      [&](std::uint32_t t, std::uint32_t corner) { order.triangles[order.ends[corner]++] = t; });
  order.ends.pop_back();
  tbb::parallel_for(std::size_t{0}, points, [&](std::size_t corner) {
    const std::span own = order.at(corner);
    if (own.size() < 2) return;
    std::ranges::sort(own, {}, [&](std::uint32_t t) {
      return std::tuple(sorted(triangles[t]), smallest_first(triangles[t]), t);
    });
  });
  return order;
}

}  // namespace relief
