#include "common/mesh/footing.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/cross.h"
#include "common/stance.h"

namespace relief {
namespace {

/// Of a mesh's height: how far its lowest points are above the lowest one. Scanned bases are not
/// flat.
constexpr double kLowest = 0.02;
// Bodies at hand that stand have a share of 0.13 or more and a margin of 0.2 or more; lying, at
// most 0.03 and less than 0. Between is nothing that could be told.
constexpr double kPlainShare = 0.1;
constexpr double kPlainMargin = 0.1;
constexpr double kSomeShare = 0.02;

struct Body {
  Bounds bounds;
  glm::dvec3 centre{0.0};  ///< of its area
  double area = 0.0;
};

/// `centre` is not divided by the area yet.
Body body_of(const Points& mesh, std::span<const Triangle> triangles) {
  Body body;
  for (const Triangle& t : triangles) {
    const glm::dvec3& a = mesh.positions[t[0]];
    const glm::dvec3& b = mesh.positions[t[1]];
    const glm::dvec3& c = mesh.positions[t[2]];
    for (const glm::dvec3& corner : {a, b, c}) extend(body.bounds, corner);
    const double area = 0.5 * glm::length(glm::cross(b - a, c - a));
    body.centre += area * (a + b + c) / 3.0;
    body.area += area;
  }
  return body;
}

Body body_of(const Points& mesh) {
  // The same on any number of threads: a part has so many triangles.
  constexpr std::size_t kPart = 65536;
  const std::span triangles(mesh.triangles);
  std::vector<Body> parts((triangles.size() + kPart - 1) / kPart);
  tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t p) {
    const auto rest = triangles.subspan(p * kPart);
    parts[p] = body_of(mesh, rest.first(std::min(kPart, rest.size())));
  });
  Body body;
  for (const Body& part : parts) {
    for (const glm::dvec3& corner : {part.bounds.min, part.bounds.max}) extend(body.bounds, corner);
    body.centre += part.centre;
    body.area += part.area;
  }
  if (body.area > 0.0) body.centre /= body.area;
  return body;
}

/// The corners of the convex hull, counterclockwise (Andrew's monotone chain).
std::vector<glm::dvec2> convex_hull(std::vector<glm::dvec2> points) {
  std::ranges::sort(points, [](const glm::dvec2& a, const glm::dvec2& b) {
    return a.x < b.x || (a.x == b.x && a.y < b.y);
  });
  std::vector<glm::dvec2> hull;
  const auto add_chain = [&hull](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (; begin != end; ++begin) {
      while (hull.size() >= start + 2 &&
             cross(hull.back() - hull[hull.size() - 2], *begin - hull.back()) <= 0.0)
        hull.pop_back();
      hull.push_back(*begin);
    }
    if (!hull.empty()) hull.pop_back();  // it starts the next chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

Footing footing_of(const Points& mesh, const Body& body, int up) {
  if (!(body.area > 0.0)) return {};
  const int u = (up + 1) % 3;
  const int v = (up + 2) % 3;
  const glm::dvec3 size = body.bounds.max - body.bounds.min;
  const double lowest = body.bounds.min[up] + kLowest * size[up];
  std::vector<glm::dvec2> low;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t k : t) {
      const glm::dvec3& p = mesh.positions[k];
      if (p[up] <= lowest) low.emplace_back(p[u], p[v]);
    }
  }
  const std::vector<glm::dvec2> hull = convex_hull(std::move(low));
  if (hull.size() < 3) return {};
  const glm::dvec2 centre(body.centre[u], body.centre[v]);
  double twice_area = 0.0;
  double inside = INFINITY;
  for (std::size_t k = 0; k < hull.size(); ++k) {
    const glm::dvec2 side = hull[(k + 1) % hull.size()] - hull[k];
    twice_area += cross(hull[k] - centre, side);
    inside = std::min(inside, cross(side, centre - hull[k]) / glm::length(side));
  }
  const double rectangle = size[u] * size[v];
  const double height = body.centre[up] - body.bounds.min[up];
  if (!(rectangle > 0.0) || !(height > 0.0)) return {};
  return {0.5 * twice_area / rectangle, inside / height};
}

}  // namespace

Footing footing_of(const Points& mesh, int up) {
  assert(up >= 0 && up < 3 && "an axis");
  return footing_of(mesh, body_of(mesh), up);
}

bool stands_on_z(const Points& mesh) {
  const Body body = body_of(mesh);
  if (!(body.area > 0.0)) return false;
  const glm::dvec3 size = body.bounds.max - body.bounds.min;
  if (size.z < kFlatHeight * std::max(size.x, size.y)) return false;
  const Footing y = footing_of(mesh, body, 1);
  if (y.share >= kSomeShare && y.margin >= 0.0) return false;
  const Footing z = footing_of(mesh, body, 2);
  return z.share >= kPlainShare && z.margin >= kPlainMargin;
}

}  // namespace relief
