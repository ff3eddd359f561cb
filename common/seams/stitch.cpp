#include "common/seams/stitch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>
#include <queue>

#include "common/seams/fill_loops.h"
#include "common/seams/front.h"
#include "common/seams/vertex_grid.h"

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
// What is farther than this from a triangle's plane, in spacings, is another sheet.
constexpr double kSheet = 0.6;

using Vertex = Front::Vertex;
using Edge = Front::Edge;

double cross2(glm::dvec2 a, glm::dvec2 b) {
  return a.x * b.y - a.y * b.x;
}

/// A triangle that could be added on a border edge from `from` to `to`.
struct Candidate {
  double score = 0.0;
  Vertex from = 0;
  Vertex to = 0;
  Vertex apex = 0;

  [[nodiscard]] bool operator<(const Candidate& b) const {  // the largest is on top of a queue
    if (score != b.score) return score > b.score;
    if (from != b.from) return from > b.from;
    return to > b.to;
  }
};

/// Grows triangles from the border until none is left that may be added.
class Growth {
 public:
  explicit Growth(Front& front) : front_(front), grid_(front.vertices()) {}

  void grow() {
    for (Vertex v = 0; v < front_.vertices().size(); ++v) {
      for (const Edge& edge : front_.at(v)) {
        if (edge.outward) suggest(v, edge.other);
      }
    }
    while (!queue_.empty()) {
      const Candidate best = queue_.top();
      queue_.pop();
      if (!front_.is_open(best.from, best.to)) continue;
      const std::optional<double> score = score_of(best.from, best.to, best.apex);
      if (score && *score <= best.score) {
        add(best);
      } else {
        suggest(best.from, best.to);  // something has changed since
      }
    }
  }

 private:
  /// Whether the corner at `v` of a triangle v, next, last lies in one gap of the border there.
  [[nodiscard]] bool fits_gap(Vertex v, Vertex next, Vertex last) const {
    const AnglesAbout angles(front_.vertex(v), front_.vertex(next).position);
    const auto angle_of = [&](Vertex w) { return angles.to(front_.vertex(w).position); };
    const double end = angle_of(last);
    if (!(end > 0.0 && end < 1.95)) return false;
    double after = 5.0;
    double before = end;
    bool ends_gap = true;    // the first edge met beyond `last` leads outward
    bool begins_gap = true;  // the last before `next` leads inward
    for (const Edge& edge : front_.at(v)) {
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

  /// Whether a vertex could be a corner: it is at the border, or nothing reaches it.
  [[nodiscard]] bool can_be_apex(Vertex v) const {
    return !front_.at(v).empty() || !front_.has_triangle(v);
  }

  /// Smaller is better; nothing if the triangle to, from, apex is none.
  [[nodiscard]] std::optional<double> score_of(Vertex from, Vertex to, Vertex apex) const {
    if (apex == from || apex == to || !can_be_apex(apex)) return {};
    const BorderVertex& a = front_.vertex(from);
    const BorderVertex& b = front_.vertex(to);
    const BorderVertex& c = front_.vertex(apex);
    const TriangleShape shape = shape_of(a.position, b.position, c.position);
    const double ab = glm::distance(a.position, b.position);
    const double bc = glm::distance(b.position, c.position);
    const double ca = glm::distance(c.position, a.position);
    if (!(shape.area > 1e-3 * ab * (bc + ca))) return {};
    const double spacing = std::max({a.spacing, b.spacing, c.spacing});
    const bool own = a.patch == b.patch && b.patch == c.patch;
    const double limit = own ? kLargestOwnRadius * spacing
                             : std::max(kLargestRadius * spacing, kLargestRadiusInEdges * ab);
    if (!(shape.radius <= limit)) return {};
    const glm::dvec3 n = shape.normal;
    if (!(glm::dot(n, a.normal) > kAgree && glm::dot(n, b.normal) > kAgree &&
          glm::dot(n, c.normal) > kAgree))
      return {};
    if (front_.is_used(from, apex) || front_.is_used(apex, to)) return {};
    const Edge* const base = front_.find(from, to);
    const Edge* const left = front_.find(apex, from);
    const Edge* const right = front_.find(to, apex);
    for (const Edge* const edge : {base, left, right}) {
      if (edge != nullptr && glm::dot(edge->normal, n) < kFold) return {};
    }
    if (!fits_gap(to, from, apex) || !fits_gap(from, apex, to) || !fits_gap(apex, to, from))
      return {};
    const double factor = left != nullptr && right != nullptr   ? kClosesTwo
                          : left != nullptr || right != nullptr ? kClosesOne
                                                                : 1.0;
    return factor * shape.radius / spacing;
  }

  /// Whether a triangle covers a vertex or crosses a border edge of its sheet.
  [[nodiscard]] bool is_free(Vertex from, Vertex to, Vertex apex) const {
    const std::array<Vertex, 3> corners{to, from, apex};
    std::array<glm::dvec3, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = front_.vertex(corners[k]).position;
    const glm::dvec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    const glm::dvec3 x = glm::normalize(p[1] - p[0]);
    const glm::dvec3 y = glm::cross(n, x);
    const auto flat = [&](glm::dvec3 q) {
      return glm::dvec2(glm::dot(q - p[0], x), glm::dot(q - p[0], y));
    };
    const std::array<glm::dvec2, 3> t{flat(p[0]), flat(p[1]), flat(p[2])};
    const glm::dvec3 middle = (p[0] + p[1] + p[2]) / 3.0;
    double reach = 0.0;
    for (const glm::dvec3& q : p) reach = std::max(reach, glm::distance(q, middle));
    const double sheet = kSheet * front_.vertex(from).spacing;
    bool free = true;
    grid_.for_each_within(middle, reach + grid_.longest_edge(), [&](Vertex v) {
      if (!free || v == from || v == to || v == apex || !can_be_apex(v)) return;
      const BorderVertex& other = front_.vertex(v);
      const glm::dvec3 d = other.position - p[0];
      if (glm::dot(other.normal, n) <= 0.0) return;
      const glm::dvec2 q = flat(other.position);
      if (std::abs(glm::dot(d, n)) < sheet && cross2(t[1] - t[0], q - t[0]) > 0.0 &&
          cross2(t[2] - t[1], q - t[1]) > 0.0 && cross2(t[0] - t[2], q - t[2]) > 0.0) {
        free = false;
        return;
      }
      for (const Edge& edge : front_.at(v)) {
        if (!edge.outward) continue;
        free = free && !crosses(corners, t, v, edge.other, {n, p[0], sheet}, q,
                                flat(front_.vertex(edge.other).position));
      }
    });
    return free;
  }

  struct Plane {
    glm::dvec3 normal;
    glm::dvec3 origin;
    double sheet;
  };

  /// Whether the edge v, w crosses one of the triangle's two new edges.
  [[nodiscard]] bool crosses(const std::array<Vertex, 3>& corners,
                             const std::array<glm::dvec2, 3>& t, Vertex v, Vertex w,
                             const Plane& plane, glm::dvec2 q, glm::dvec2 r) const {
    for (const std::size_t side : {1U, 2U}) {
      const std::size_t next = (side + 1) % 3;
      if (w == corners[side] || w == corners[next]) continue;
      const double s0 = cross2(t[next] - t[side], q - t[side]);
      const double s1 = cross2(t[next] - t[side], r - t[side]);
      const double u0 = cross2(r - q, t[side] - q);
      const double u1 = cross2(r - q, t[next] - q);
      if (s0 * s1 >= 0.0 || u0 * u1 >= 0.0) continue;
      const double part = s0 / (s0 - s1);
      const glm::dvec3 at = glm::mix(front_.vertex(v).position, front_.vertex(w).position, part);
      if (std::abs(glm::dot(at - plane.origin, plane.normal)) < plane.sheet) return true;
    }
    return false;
  }

  /// Puts the best triangle on a border edge into the queue, if there is one.
  void suggest(Vertex from, Vertex to) {
    const BorderVertex& a = front_.vertex(from);
    const BorderVertex& b = front_.vertex(to);
    const double length = glm::distance(a.position, b.position);
    const double spacing = std::max(a.spacing, b.spacing);
    const double reach = 2.0 * std::max(kLargestRadius * spacing, kLargestRadiusInEdges * length);
    found_.clear();
    grid_.for_each_within(0.5 * (a.position + b.position), reach, [&](Vertex v) {
      if (const std::optional<double> score = score_of(from, to, v))
        found_.push_back({*score, from, to, v});
    });
    std::sort(found_.begin(), found_.end(), [](const Candidate& x, const Candidate& y) {
      return x.score != y.score ? x.score < y.score : x.apex < y.apex;
    });
    for (const Candidate& candidate : found_) {
      if (!is_free(from, to, candidate.apex)) continue;
      queue_.push(candidate);
      return;
    }
  }

  void add(const Candidate& c) {
    if (!is_free(c.from, c.to, c.apex)) {
      suggest(c.from, c.to);
      return;
    }
    front_.attach(c.from, c.to, c.apex);
    if (front_.is_open(c.from, c.apex)) suggest(c.from, c.apex);
    if (front_.is_open(c.apex, c.to)) suggest(c.apex, c.to);
  }

  Front& front_;
  VertexGrid grid_;
  std::priority_queue<Candidate> queue_;
  std::vector<Candidate> found_;
};

}  // namespace

std::vector<Triangle> stitch(const BorderMesh& mesh, bool is_closed) {
  Front front(mesh);
  Growth(front).grow();
  fill_loops(front, is_closed);
  return front.take();
}

}  // namespace relief
