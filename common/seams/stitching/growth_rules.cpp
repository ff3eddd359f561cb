#include "common/seams/stitching/growth_rules.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "common/seams/crease_between.h"
#include "common/seams/stitching/new_triangle.h"

namespace relief {
namespace {

// A triangle's circumscribed circle may be this large, in spacings: gaps between patches that end
// half-way are about 1.4 wide, diagonally 2.
constexpr double kLargestRadius = 1.6;
// ... between samples of one patch, where only notches are closed.
constexpr double kLargestOwnRadius = 1.05;
// An edge that jumps may be longer than that circle; then the circle is this, in edges.
constexpr double kLargestRadiusInEdges = 0.7;
// A triangle's normal and those of its corners agree if the cosine between them exceeds this.
constexpr double kAgree = 0.1;
// Neighbouring triangles fold if the cosine between their normals is below this.
constexpr double kFold = -0.6;
// Triangles that close one or both of their other edges come before others of their size.
constexpr double kClosesOne = 0.8;
constexpr double kClosesTwo = 0.4;

using Vertex = Front::Vertex;
using Edge = Front::Edge;

/// Whether the corner at `v` of a triangle v, next, last lies in one gap of the border there, seen
/// from `outward`.
bool fits_gap(const Front& front, Vertex v, Vertex next, Vertex last, glm::dvec3 outward) {
  const AnglesAbout angles(front.vertex(v).position, outward, front.vertex(next).position);
  const auto angle_of = [&](Vertex w) { return angles.to(front.vertex(w).position); };
  const double end = angle_of(last);
  if (!(end > 0.0 && end < 1.95)) return false;
  double after = 5.0;
  double before = end;
  bool ends_gap = true;    // the first edge met beyond `last` leads outward
  bool begins_gap = true;  // the last before `next` leads inward
  for (const Edge& edge : front.at(v)) {
    if (edge.other == next) {
      if (edge.outward) return false;
      begins_gap = true;
      before = 5.0;
      continue;
    }
    if (edge.other == last) {
      if (!edge.outward) return false;
      ends_gap = true;
      after = -1.0;
      continue;
    }
    const double angle = angle_of(edge.other);
    if (angle < end) return false;
    if (angle < after) {
      after = angle;
      ends_gap = edge.outward;
    }
    if (angle >= before) {
      before = angle;
      begins_gap = !edge.outward;
    }
  }
  return ends_gap && begins_gap;
}

/// Whether outward_at_edge() of three vertices may be something. `apex`: normal of the third.
bool may_be_at_edge(const BorderVertex& from, const BorderVertex& to, glm::dvec3 apex) {
  // A little more, for rounding.
  constexpr double kMayBe = kRightEdge + 1e-5;
  return glm::dot(from.normal, apex) < kMayBe || glm::dot(to.normal, apex) < kMayBe ||
         glm::dot(from.normal, to.normal) < kMayBe;
}

/// Whether a triangle to, from, apex may face the side of its edge's ends, or be at a sharp edge,
/// and have a circumscribed circle as small as `radius`. Spares most others, of which half are
/// behind the edge, their square roots and what is to be known of their apex.
bool may_be_good(const BorderVertex& from, const BorderVertex& to, const VertexGrid::Place& apex,
                 double radius) {
  const glm::dvec3 a = from.position;
  const glm::dvec3 b = to.position;
  const glm::dvec3 across = glm::cross(a - b, apex.position - b);
  // The unit normal's cosines, which are to exceed kAgree, have the same signs.
  static_assert(kAgree > 0.0);
  const bool faces_ends = glm::dot(across, from.normal) > 0.0 && glm::dot(across, to.normal) > 0.0;
  if (!faces_ends && !may_be_at_edge(from, to, apex.normal)) return false;
  const auto squared = [](glm::dvec3 d) { return glm::dot(d, d); };
  const double edges = squared(b - a) * squared(apex.position - b) * squared(a - apex.position);
  // A little more, for rounding.
  return edges <= 1.001 * 4.0 * radius * radius * squared(across);
}

}  // namespace

std::optional<double> GrowthRules::score_of(Vertex from, Vertex to, Vertex apex) const {
  if (apex == from || apex == to || !front_.is_live(apex)) return {};
  const BorderVertex& a = front_.vertex(from);
  const BorderVertex& b = front_.vertex(to);
  const BorderVertex& c = front_.vertex(apex);
  const double ab = glm::distance(a.position, b.position);
  const double bc = glm::distance(b.position, c.position);
  const double ca = glm::distance(c.position, a.position);
  const double spacing = std::max({a.spacing, b.spacing, c.spacing});
  const bool own = a.patch == b.patch && b.patch == c.patch;
  const double limit = own ? kLargestOwnRadius * spacing
                           : std::max(kLargestRadius * spacing, kLargestRadiusInEdges * ab);
  const TriangleShape shape = shape_of(a.position, b.position, c.position);
  if (!(shape.area > 1e-3 * ab * (bc + ca))) return {};
  if (!(shape.radius <= limit)) return {};
  const glm::dvec3 n = shape.normal;
  const std::optional<glm::dvec3> outward = outward_at_edge(a, b, c);
  const bool agrees = outward ? glm::dot(n, *outward) > kAgree
                              : glm::dot(n, a.normal) > kAgree && glm::dot(n, b.normal) > kAgree &&
                                    glm::dot(n, c.normal) > kAgree;
  if (!agrees) return {};
  if (front_.is_used(from, apex) || front_.is_used(apex, to)) return {};
  const Edge* const base = front_.find(from, to);
  const Edge* const left = front_.find(apex, from);
  const Edge* const right = front_.find(to, apex);
  // Triangles at a sharp edge may turn as far as its faces do.
  for (const Edge* const edge : {base, left, right}) {
    if (edge == nullptr || !(glm::dot(edge->normal, n) < kFold)) continue;
    if (!outward || !(glm::dot(edge->normal, *outward) > kAgree)) return {};
  }
  if (!fits_gap(front_, to, from, apex, outward.value_or(b.normal)) ||
      !fits_gap(front_, from, apex, to, outward.value_or(a.normal)) ||
      !fits_gap(front_, apex, to, from, outward.value_or(c.normal)))
    return {};
  const double factor = left != nullptr && right != nullptr   ? kClosesTwo
                        : left != nullptr || right != nullptr ? kClosesOne
                                                              : 1.0;
  return factor * shape.radius / spacing;
}

bool GrowthRules::is_free(Vertex from, Vertex to, Vertex apex) const {
  const NewTriangle triangle(front_, from, to, apex);
  const glm::dvec3 middle = triangle.middle();
  // Edges that begin farther away do not count.
  const double farthest = triangle.reach() + grid_.longest_edge();
  const auto counts = [&](Vertex v) {
    const glm::dvec3 d = front_.vertex(v).position - middle;
    return !triangle.has_corner(v) && glm::dot(d, d) <= farthest * farthest && triangle.faces(v);
  };
  // One end of an edge over the triangle is at most half its length farther away than what is over
  // it.
  const double over = triangle.over();
  bool free = true;
  grid_.for_each_within(
      middle, over + 0.5 * front_.longest(), [&](const VertexGrid::Place& place, double squared) {
        const Vertex v = place.vertex;
        const double near = over + 0.5 * front_.longest_at(v);
        if (!free || squared > near * near || !front_.is_live(v)) return;
        const bool own = counts(v);
        if (own && triangle.covers(v)) {
          free = false;
          return;
        }
        for (const Edge& edge : front_.at(v)) {
          const bool crosses = edge.outward ? own && triangle.crosses(v, edge.other)
                                            : counts(edge.other) && triangle.crosses(edge.other, v);
          free = free && !crosses;
        }
      });
  return free;
}

GrowthRules::Surroundings GrowthRules::surroundings_of(Vertex from, Vertex to, Vertex apex) const {
  const NewTriangle triangle(front_, from, to, apex);
  return {triangle.middle(), triangle.over()};
}

std::optional<GrowthCandidate> GrowthRules::best_on(Vertex from, Vertex to) const {
  const BorderVertex& a = front_.vertex(from);
  const BorderVertex& b = front_.vertex(to);
  const double length = glm::distance(a.position, b.position);
  const double spacing = std::max(a.spacing, b.spacing);
  const double reach = 2.0 * std::max(kLargestRadius * spacing, kLargestRadiusInEdges * length);
  // Whatever the apex's patch: its circle may not be larger.
  const double largest = std::max(kLargestRadius * std::max(spacing, grid_.largest_spacing()),
                                  kLargestRadiusInEdges * length);
  std::vector<GrowthCandidate> found;
  grid_.for_each_within(
      0.5 * (a.position + b.position), reach, [&](const VertexGrid::Place& place, double) {
        if (may_be_good(a, b, place, largest)) {
          if (const std::optional<double> score = score_of(from, to, place.vertex))
            found.push_back({*score, from, to, place.vertex});
        }
      });
  std::sort(found.begin(), found.end(), [](const GrowthCandidate& x, const GrowthCandidate& y) {
    return x.score != y.score ? x.score < y.score : x.apex < y.apex;
  });
  for (const GrowthCandidate& candidate : found) {
    if (is_free(from, to, candidate.apex)) return candidate;
  }
  return {};
}

}  // namespace relief
