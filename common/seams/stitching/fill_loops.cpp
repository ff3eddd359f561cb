#include "common/seams/stitching/fill_loops.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "common/disjoint_sets.h"

namespace relief {
namespace {

// Loops of up to this many edges are filled; larger ones are holes of the scan.
constexpr std::size_t kSmallLoop = 14;
// ... of one patch, if a node within may be missing. A hole of one node has four, of two six;
// support leaves none that narrow (find_support).
constexpr std::size_t kSmallOwnLoop = 6;
// ... of a surface that has no holes. A narrow face of fandisk that no sample is left of has 86.
constexpr std::size_t kSmallClosedLoop = 128;
// An island has at most this many border vertices for each edge of its outside, which stays open.
constexpr std::size_t kIslandPerEdge = 8;
// An ear that folds over comes after all others: what is left open shows as a hole, a fold does
// not.
constexpr double kFolds = 1e6;
// What is this little beyond an ear's edge, as a share of its area, is on it.
constexpr double kOnEdge = 1e-3;
constexpr double kNoEar = std::numeric_limits<double>::infinity();

using Vertex = Front::Vertex;
using Loop = std::vector<Vertex>;

/// The corners of an ear: a vertex of a loop between those before and after it.
struct Ear {
  Vertex before = 0;
  Vertex middle = 0;
  Vertex after = 0;
};

Ear ear_at(const Loop& loop, std::size_t k) {
  return {loop[(k + loop.size() - 1) % loop.size()], loop[k], loop[(k + 1) % loop.size()]};
}

/// Where the border goes on from `at`, which it has come to from `before`: to the first edge
/// outward, counterclockwise, beyond the gap.
std::optional<Vertex> next_along(const Front& front, Vertex before, Vertex at) {
  const BorderVertex& middle = front.vertex(at);
  const AnglesAbout angles(middle.position, middle.normal, front.vertex(before).position);
  std::optional<Vertex> next;
  double least = 5.0;
  for (const Front::Edge& edge : front.at(at)) {
    if (!edge.outward) continue;
    const double angle = angles.to(front.vertex(edge.other).position);
    if (angle < least) {
      least = angle;
      next = edge.other;
    }
  }
  return next;
}

/// The loop of border edges that one leads to; empty if it is longer than `most`.
Loop loop_from(const Front& front, Vertex from, Vertex to, std::size_t most) {
  Loop loop{from};
  while (true) {
    // What comes back to a vertex is a loop of its own.
    const auto met = std::ranges::find(loop, to);
    if (met != loop.end()) {
      loop.erase(loop.begin(), met);
      return loop.size() < 3 ? Loop{} : loop;
    }
    if (loop.size() == most) return {};
    const std::optional<Vertex> next = next_along(front, loop.back(), to);
    if (!next) return {};
    loop.push_back(to);
    to = *next;
  }
}

/// The border vertices that triangles connect, directly or by way of others.
DisjointSets find_connections(const Front& front) {
  DisjointSets connected(front.vertices().size());
  for (const BorderEdge& edge : front.mesh().edges) connected.join(edge.from, edge.to);
  for (const Triangle& t : front.triangles()) {
    connected.join(t[0], t[1]);
    connected.join(t[1], t[2]);
  }
  for (Vertex v = 0; v < front.mesh().parts.size(); ++v) connected.join(v, front.mesh().parts[v]);
  return connected;
}

/// Whether triangles that fill a loop would face inward: it is the outside of an island, or the
/// surface overlaps itself there.
bool faces_inward(const Front& front, const Loop& loop) {
  glm::dvec3 area(0.0);
  glm::dvec3 outward(0.0);
  const glm::dvec3 base = front.vertex(loop.front()).position;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const Ear ear = ear_at(loop, k);
    area += glm::cross(front.vertex(ear.after).position - base,
                       front.vertex(ear.middle).position - base);
    outward += front.vertex(ear.middle).normal;
  }
  return glm::dot(area, outward) < 0.0;
}

/// Whether a loop is of one patch, and not where its cells alone are too steep: in iron_scan such
/// slits had eight edges.
bool may_be_hole_of_scan(const Front& front, const Loop& loop) {
  const std::uint32_t patch = front.vertex(loop.front()).patch;
  return std::ranges::all_of(loop, [&](Vertex v) { return front.vertex(v).patch == patch; }) &&
         std::ranges::any_of(loop, [&](Vertex v) { return front.vertex(v).beside_hole; });
}

/// Whether an ear covers another vertex of its loop or has it on an edge, so that what is left of
/// the loop folds over or has no area.
bool covers(const Front& front, const Loop& loop, const Ear& ear, const TriangleShape& shape) {
  const glm::dvec3 a = front.vertex(ear.after).position;
  const glm::dvec3 b = front.vertex(ear.middle).position;
  const glm::dvec3 c = front.vertex(ear.before).position;
  return std::ranges::any_of(loop, [&](Vertex v) {
    if (v == ear.before || v == ear.middle || v == ear.after) return false;
    const glm::dvec3 p = front.vertex(v).position;
    const auto is_left = [&](glm::dvec3 from, glm::dvec3 to) {
      return glm::dot(glm::cross(to - from, p - from), shape.normal) > -kOnEdge * shape.area;
    };
    return is_left(a, b) && is_left(b, c) && is_left(c, a);
  });
}

/// How good an ear is: smaller is better.
double score_of(const Front& front, const Loop& loop, const Ear& ear) {
  const BorderVertex& a = front.vertex(ear.before);
  const BorderVertex& b = front.vertex(ear.middle);
  const BorderVertex& c = front.vertex(ear.after);
  const TriangleShape shape = shape_of(a.position, b.position, c.position);
  const double ab = glm::distance(a.position, b.position);
  const double bc = glm::distance(b.position, c.position);
  if (!(shape.area > 1e-6 * ab * bc)) return kNoEar;
  const double agreement =
      std::min({glm::dot(shape.normal, a.normal), glm::dot(shape.normal, b.normal),
                glm::dot(shape.normal, c.normal)});
  const double ca = glm::distance(c.position, a.position);
  const bool folds = agreement < 0.0 || covers(front, loop, ear, shape);
  return (folds ? kFolds : 1.0) * (2.0 - agreement) * ab * bc * ca / shape.area;
}

/// Cuts ears off a loop until nothing is left of it, or none that is allowed.
void fill(Front& front, Loop loop) {
  while (loop.size() >= 3) {
    std::size_t best = 0;
    double least = kNoEar;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Ear ear = ear_at(loop, k);
      if (loop.size() > 3 &&
          (front.is_used(ear.before, ear.after) || front.is_used(ear.after, ear.before)))
        continue;
      const double score = score_of(front, loop, ear);
      if (score < least) {
        least = score;
        best = k;
      }
    }
    if (least == kNoEar) {
      // Three vertices on a line: without their triangle, which has no area, the edges stay open.
      if (loop.size() == 3) front.attach(loop[2], loop[0], loop[1]);
      return;
    }
    const Ear ear = ear_at(loop, best);
    front.attach(ear.before, ear.middle, ear.after);
    if (loop.size() == 3) return;
    loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
  }
}

}  // namespace

void fill_loops(Front& front, bool is_closed) {
  DisjointSets connections = find_connections(front);
  for (Vertex v = 0; v < front.vertices().size(); ++v) {
    const std::vector<Front::Edge> edges(front.at(v).begin(), front.at(v).end());
    for (const Front::Edge& edge : edges) {
      if (!edge.outward || !front.is_open(v, edge.other)) continue;
      const Loop loop = loop_from(front, v, edge.other, is_closed ? kSmallClosedLoop : kSmallLoop);
      if (!is_closed && loop.size() > kSmallOwnLoop && may_be_hole_of_scan(front, loop)) continue;
      const bool is_island = !loop.empty() && faces_inward(front, loop) &&
                             connections.size(v) <= kIslandPerEdge * loop.size();
      if (!is_island) fill(front, loop);
    }
  }
}

}  // namespace relief
