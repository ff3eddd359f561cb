#include "common/seams/stitch.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <unordered_set>

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

// Loops of up to this many edges are filled; larger ones are holes of the scan.
constexpr std::size_t kSmallLoop = 14;
// ... of one patch, where cells are too steep; a hole of one node has four.
constexpr std::size_t kSmallOwnLoop = 4;
// The least cosine between an ear that fills one and the normals of its corners: what is left open
// shows as a hole, what is askew does not.
constexpr double kEarAgrees = -0.9;
constexpr double kNoEar = std::numeric_limits<double>::infinity();

using Vertex = std::uint32_t;

std::uint64_t key_of(Vertex from, Vertex to) {
  return (std::uint64_t{from} << 32U) | to;
}

/// The direction of `d` about a normal as a number from 0 to 4 that grows with the angle.
double angle_number(double x, double y) {
  const double sum = std::abs(x) + std::abs(y);
  if (sum == 0.0) return 0.0;
  const double t = y / sum;
  if (x < 0.0) return 2.0 - t;
  return t < 0.0 ? 4.0 + t : t;
}

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

class Front {
 public:
  explicit Front(const BorderMesh& mesh)
      : vertices_(mesh.vertices), grid_(mesh.vertices), at_(mesh.vertices.size()) {
    used_.reserve(2 * mesh.edges.size());
    for (const BorderEdge& edge : mesh.edges) {
      used_.insert(key_of(edge.from, edge.to));
      has_triangle_.resize(vertices_.size(), 0);
      has_triangle_[edge.from] = 1;
      has_triangle_[edge.to] = 1;
    }
    has_triangle_.resize(vertices_.size(), 0);
    for (const BorderEdge& edge : mesh.edges) {
      if (used_.contains(key_of(edge.to, edge.from))) continue;
      open(edge.from, edge.to, edge.normal);
    }
  }

  std::vector<Triangle> grow() {
    for (Vertex v = 0; v < at_.size(); ++v) {
      for (const Edge& edge : at_[v]) {
        if (edge.outward) suggest(v, edge.other);
      }
    }
    while (!queue_.empty()) {
      const Candidate best = queue_.top();
      queue_.pop();
      if (!is_open(best.from, best.to)) continue;
      const std::optional<double> score = score_of(best.from, best.to, best.apex);
      if (score && *score <= best.score) {
        add(best);
      } else {
        suggest(best.from, best.to);  // something has changed since
      }
    }
    fill_loops();
    return std::move(triangles_);
  }

 private:
  using Loop = std::vector<Vertex>;

  /// The loop of border edges that begins with one; empty if it is longer than a small one or
  /// meets itself.
  [[nodiscard]] Loop loop_from(Vertex from, Vertex to) const {
    Loop loop{from};
    while (true) {
      // What comes back to a vertex is a loop of its own.
      const auto met = std::ranges::find(loop, to);
      if (met != loop.end()) {
        loop.erase(loop.begin(), met);
        break;
      }
      if (loop.size() == kSmallLoop) return {};
      const std::optional<Vertex> next = next_along(loop.back(), to);
      if (!next) return {};
      loop.push_back(to);
      to = *next;
    }
    return loop.size() < 3 ? Loop{} : loop;
  }

  /// Where the border goes on from `at`, which it has come to from `before`: to the first edge
  /// outward, counterclockwise, beyond the gap.
  [[nodiscard]] std::optional<Vertex> next_along(Vertex before, Vertex at) const {
    const BorderVertex& middle = vertices_[at];
    const glm::dvec3 back = vertices_[before].position - middle.position;
    const glm::dvec3 x = back - glm::dot(back, middle.normal) * middle.normal;
    const glm::dvec3 y = glm::cross(middle.normal, x);
    std::optional<Vertex> next;
    double least = 5.0;
    for (const Edge& edge : at_[at]) {
      if (!edge.outward) continue;
      const glm::dvec3 d = vertices_[edge.other].position - middle.position;
      const double angle = angle_number(glm::dot(d, x), glm::dot(d, y));
      if (angle < least) {
        least = angle;
        next = edge.other;
      }
    }
    return next;
  }

  /// How good an ear is that cuts a corner off a loop: smaller is better.
  [[nodiscard]] double ear_score(const Loop& loop, std::size_t k) const {
    const BorderVertex& a = vertices_[loop[(k + loop.size() - 1) % loop.size()]];
    const BorderVertex& b = vertices_[loop[k]];
    const BorderVertex& c = vertices_[loop[(k + 1) % loop.size()]];
    const glm::dvec3 normal = glm::cross(a.position - b.position, c.position - b.position);
    const double area = glm::length(normal);
    const double ab = glm::distance(a.position, b.position);
    const double bc = glm::distance(b.position, c.position);
    const double ca = glm::distance(c.position, a.position);
    if (!(area > 1e-6 * ab * bc)) return kNoEar;
    const glm::dvec3 n = normal / area;
    const double agreement =
        std::min({glm::dot(n, a.normal), glm::dot(n, b.normal), glm::dot(n, c.normal)});
    if (agreement < kEarAgrees) return kNoEar;
    return (2.0 - agreement) * ab * bc * ca / area;
  }

  /// Cuts ears off a loop until nothing is left of it, or none that is allowed.
  void fill(Loop loop) {
    while (loop.size() >= 3) {
      std::size_t best = 0;
      double least = kNoEar;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const Vertex before = loop[(k + loop.size() - 1) % loop.size()];
        const Vertex after = loop[(k + 1) % loop.size()];
        if (loop.size() > 3 &&
            (used_.contains(key_of(before, after)) || used_.contains(key_of(after, before))))
          continue;
        const double score = ear_score(loop, k);
        if (score < least) {
          least = score;
          best = k;
        }
      }
      if (least == kNoEar) return;
      const Vertex before = loop[(best + loop.size() - 1) % loop.size()];
      const Vertex after = loop[(best + 1) % loop.size()];
      attach({0.0, before, loop[best], after});
      if (loop.size() == 3) return;
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(best));
    }
  }

  /// Small loops between patches, which no triangle could be grown in.
  void fill_loops() {
    for (Vertex v = 0; v < at_.size(); ++v) {
      const std::vector<Edge> edges = at_[v];
      for (const Edge& edge : edges) {
        if (!edge.outward || !is_open(v, edge.other)) continue;
        const Loop loop = loop_from(v, edge.other);
        const bool several = std::ranges::any_of(
            loop, [&](Vertex w) { return vertices_[w].patch != vertices_[v].patch; });
        if (several || loop.size() <= kSmallOwnLoop) fill(loop);
      }
    }
  }

  /// A border edge at one of its ends.
  struct Edge {
    Vertex other = 0;
    bool outward = false;  ///< from the vertex to the other
    glm::dvec3 normal{0.0};
  };

  [[nodiscard]] const Edge* find(Vertex from, Vertex to) const {
    for (const Edge& edge : at_[from]) {
      if (edge.outward && edge.other == to) return &edge;
    }
    return nullptr;
  }
  [[nodiscard]] bool is_open(Vertex from, Vertex to) const { return find(from, to) != nullptr; }

  void open(Vertex from, Vertex to, glm::dvec3 normal) {
    at_[from].push_back({to, true, normal});
    at_[to].push_back({from, false, normal});
  }
  void close(Vertex from, Vertex to) {
    std::erase_if(at_[from], [to](const Edge& e) { return e.outward && e.other == to; });
    std::erase_if(at_[to], [from](const Edge& e) { return !e.outward && e.other == from; });
  }

  /// Whether the corner at `v` of a triangle v, next, last lies in one gap of the border there.
  [[nodiscard]] bool fits_gap(Vertex v, Vertex next, Vertex last) const {
    const BorderVertex& at = vertices_[v];
    const glm::dvec3 along = vertices_[next].position - at.position;
    const glm::dvec3 x = along - glm::dot(along, at.normal) * at.normal;
    const glm::dvec3 y = glm::cross(at.normal, x);
    const auto angle_of = [&](Vertex w) {
      const glm::dvec3 d = vertices_[w].position - at.position;
      return angle_number(glm::dot(d, x), glm::dot(d, y));
    };
    const double end = angle_of(last);
    if (!(end > 0.0 && end < 1.95)) return false;
    double after = 5.0;
    double before = end;
    bool ends_gap = true;    // the first edge met beyond `last` leads outward
    bool begins_gap = true;  // the last before `next` leads inward
    for (const Edge& edge : at_[v]) {
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
    return !at_[v].empty() || has_triangle_[v] == 0;
  }

  /// Smaller is better; nothing if the triangle to, from, apex is none.
  [[nodiscard]] std::optional<double> score_of(Vertex from, Vertex to, Vertex apex) const {
    if (apex == from || apex == to || !can_be_apex(apex)) return {};
    const BorderVertex& a = vertices_[from];
    const BorderVertex& b = vertices_[to];
    const BorderVertex& c = vertices_[apex];
    const glm::dvec3 normal = glm::cross(a.position - b.position, c.position - b.position);
    const double area = glm::length(normal);
    const double ab = glm::distance(a.position, b.position);
    const double bc = glm::distance(b.position, c.position);
    const double ca = glm::distance(c.position, a.position);
    if (!(area > 1e-3 * ab * (bc + ca))) return {};
    const double radius = ab * bc * ca / (2.0 * area);
    const double spacing = std::max({a.spacing, b.spacing, c.spacing});
    const bool own = a.patch == b.patch && b.patch == c.patch;
    const double limit = own ? kLargestOwnRadius * spacing
                             : std::max(kLargestRadius * spacing, kLargestRadiusInEdges * ab);
    if (!(radius <= limit)) return {};
    const glm::dvec3 n = normal / area;
    if (!(glm::dot(n, a.normal) > kAgree && glm::dot(n, b.normal) > kAgree &&
          glm::dot(n, c.normal) > kAgree))
      return {};
    if (used_.contains(key_of(from, apex)) || used_.contains(key_of(apex, to))) return {};
    const Edge* const base = find(from, to);
    const Edge* const left = find(apex, from);
    const Edge* const right = find(to, apex);
    for (const Edge* const edge : {base, left, right}) {
      if (edge != nullptr && glm::dot(edge->normal, n) < kFold) return {};
    }
    if (!fits_gap(to, from, apex) || !fits_gap(from, apex, to) || !fits_gap(apex, to, from))
      return {};
    const double factor = left != nullptr && right != nullptr   ? kClosesTwo
                          : left != nullptr || right != nullptr ? kClosesOne
                                                                : 1.0;
    return factor * radius / spacing;
  }

  /// Whether a triangle covers a vertex or crosses a border edge of its sheet.
  [[nodiscard]] bool is_free(Vertex from, Vertex to, Vertex apex) const {
    const std::array<Vertex, 3> corners{to, from, apex};
    std::array<glm::dvec3, 3> p{};
    for (std::size_t k = 0; k < 3; ++k) p[k] = vertices_[corners[k]].position;
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
    const double sheet = kSheet * vertices_[from].spacing;
    bool free = true;
    grid_.for_each_within(middle, reach + grid_.longest_edge(), [&](Vertex v) {
      if (!free || v == from || v == to || v == apex || !can_be_apex(v)) return;
      const BorderVertex& other = vertices_[v];
      const glm::dvec3 d = other.position - p[0];
      if (glm::dot(other.normal, n) <= 0.0) return;
      const glm::dvec2 q = flat(other.position);
      if (std::abs(glm::dot(d, n)) < sheet && cross2(t[1] - t[0], q - t[0]) > 0.0 &&
          cross2(t[2] - t[1], q - t[1]) > 0.0 && cross2(t[0] - t[2], q - t[2]) > 0.0) {
        free = false;
        return;
      }
      for (const Edge& edge : at_[v]) {
        if (!edge.outward) continue;
        free = free && !crosses(corners, t, v, edge.other, {n, p[0], sheet}, q,
                                flat(vertices_[edge.other].position));
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
      const glm::dvec3 at = glm::mix(vertices_[v].position, vertices_[w].position, part);
      if (std::abs(glm::dot(at - plane.origin, plane.normal)) < plane.sheet) return true;
    }
    return false;
  }

  /// Puts the best triangle on a border edge into the queue, if there is one.
  void suggest(Vertex from, Vertex to) {
    const BorderVertex& a = vertices_[from];
    const BorderVertex& b = vertices_[to];
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
    attach(c);
    if (is_open(c.from, c.apex)) suggest(c.from, c.apex);
    if (is_open(c.apex, c.to)) suggest(c.apex, c.to);
  }

  /// Adds a triangle and moves the border to its other edges.
  void attach(const Candidate& c) {
    const glm::dvec3 p = vertices_[c.to].position;
    const glm::dvec3 normal =
        glm::normalize(glm::cross(vertices_[c.from].position - p, vertices_[c.apex].position - p));
    triangles_.push_back({c.to, c.from, c.apex});
    has_triangle_[c.apex] = 1;
    used_.insert(key_of(c.to, c.from));
    close(c.from, c.to);
    const std::array<std::array<Vertex, 2>, 2> added{{{c.from, c.apex}, {c.apex, c.to}}};
    for (const auto& [from, to] : added) {
      used_.insert(key_of(from, to));
      if (is_open(to, from)) {
        close(to, from);
      } else {
        open(from, to, normal);
      }
    }
  }

  const std::vector<BorderVertex>& vertices_;
  VertexGrid grid_;
  std::vector<std::vector<Edge>> at_;  ///< the border edges at each vertex
  std::vector<std::uint8_t> has_triangle_;
  std::unordered_set<std::uint64_t> used_;  ///< directed edges that have a triangle on their left
  std::priority_queue<Candidate> queue_;
  std::vector<Candidate> found_;
  std::vector<Triangle> triangles_;
};

}  // namespace

std::vector<Triangle> stitch(const BorderMesh& mesh) {
  return Front(mesh).grow();
}

}  // namespace relief
