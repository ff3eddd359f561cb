#include "preprocess/densify.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <unordered_set>

namespace relief {
namespace {

// An edge longer than this many mean spacings gets points of its own.
constexpr double kLongEdge = 2.5;

double total_area(const Points& points) {
  double area = 0.0;
  for (const Triangle& t : points.triangles) {
    const glm::dvec3 a = points.positions[t[0]];
    area += 0.5 * glm::length(glm::cross(points.positions[t[1]] - a, points.positions[t[2]] - a));
  }
  return area;
}

// Appends the point with barycentric weights `w` in triangle `t`.
void append(Points& points, const Triangle& t, glm::dvec3 w) {
  const auto mix = [&](const auto& values, auto zero) {
    for (glm::length_t c = 0; c < 3; ++c) {
      zero += static_cast<typename decltype(zero)::value_type>(w[c]) *
              decltype(zero)(values[t[static_cast<std::size_t>(c)]]);
    }
    return zero;
  };
  points.positions.push_back(mix(points.positions, glm::dvec3(0.0)));
  if (!points.normals.empty()) points.normals.push_back(mix(points.normals, glm::vec3(0.0F)));
  if (!points.colours.empty()) {
    points.colours.emplace_back(mix(points.colours, glm::vec3(0.0F)) + 0.5F);
  }
  if (!points.texcoords.empty()) points.texcoords.push_back(mix(points.texcoords, glm::vec2(0.0F)));
}

}  // namespace

std::size_t densify_triangles(Points& points) {
  const std::size_t given = points.size();
  if (points.triangles.empty() || given == 0) return 0;
  const double spacing = std::sqrt(total_area(points) / static_cast<double>(given));
  const auto room = [&] { return points.size() < 2 * given; };
  const auto pieces = [&](std::uint32_t a, std::uint32_t b) {
    const double length = glm::distance(points.positions[a], points.positions[b]);
    return length > kLongEdge * spacing ? static_cast<int>(std::min(length / spacing, 4096.0)) + 1
                                        : 1;
  };
  std::unordered_set<std::uint64_t> edges_done;
  for (const Triangle& t : points.triangles) {
    int most = 1;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = std::min(t[c], t[(c + 1) % 3]);
      const std::uint32_t b = std::max(t[c], t[(c + 1) % 3]);
      const int n = pieces(a, b);
      most = std::max(most, n);
      if (n == 1 || !edges_done.insert(std::uint64_t{a} << 32 | b).second) continue;
      for (int i = 1; i < n && room(); ++i) {
        const double s = static_cast<double>(i) / n;
        append(points, {a, b, b}, {1.0 - s, s, 0.0});
      }
    }
    for (int i = 1; i < most; ++i) {
      for (int j = 1; i + j < most && room(); ++j) {
        const glm::dvec2 w = glm::dvec2(i, j) / static_cast<double>(most);
        append(points, t, {1.0 - w.x - w.y, w.x, w.y});
      }
    }
  }
  return points.size() - given;
}

}  // namespace relief
