#include "common/seams/seam_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/flat_map.h"
#include "common/mesh/creases.h"
#include "common/seams/crease_between.h"
#include "common/seams/planes.h"

namespace relief {
namespace {

// A seam vertex moves to a crease by this many spacings of the coarser patch at most: samples on
// both sides end up to a cell before it. Planes through few samples may meet anywhere.
constexpr double kCreaseReach = 1.5;

// Three planes have a common corner if their unit normals span this volume.
constexpr double kCornerVolume = 0.3;

Plane plane_of(const BorderVertex& v) {
  return {v.position, v.plane_normal};
}

/// How far a seam vertex between them may move.
double reach_between(const BorderVertex& a, const BorderVertex& b) {
  const double spacing = std::max(a.spacing, b.spacing);
  if (is_plane(a) && is_plane(b)) return kCreaseReach * spacing;
  return kCreaseReach * std::min(spacing, glm::distance(a.position, b.position));
}

/// Whether `a` and `b` are on one side of a crease, and `c` is on the other.
bool face_across(const BorderVertex& a, const BorderVertex& b, const BorderVertex& c) {
  return glm::dot(a.plane_normal, b.plane_normal) > kCreaseCosine && meet_at_crease(a, c) &&
         meet_at_crease(b, c);
}

/// The way from the middle of a junction to where creases meet there, or to the one that passes two
/// patches of a side; 0 without creases.
glm::dvec3 to_creases(const BorderVertex& a, const BorderVertex& b, const BorderVertex& c,
                      glm::dvec3 middle) {
  const Plane at_a = plane_of(a);
  const Plane at_b = plane_of(b);
  const Plane at_c = plane_of(c);
  if (face_across(a, b, c)) return to_crease(mean(at_a, at_b), at_c, middle);
  if (face_across(b, c, a)) return to_crease(mean(at_b, at_c), at_a, middle);
  if (face_across(c, a, b)) return to_crease(mean(at_c, at_a), at_b, middle);
  const bool is_corner = meet_at_crease(a, b) && meet_at_crease(b, c) && meet_at_crease(c, a);
  if (!is_corner || std::abs(volume_of(at_a, at_b, at_c)) < kCornerVolume) return glm::dvec3(0.0);
  return to_corner(at_a, at_b, at_c, middle);
}

class Sharing {
 public:
  Sharing(const BorderMesh& mesh, Seams& seams) : vertices_(mesh.vertices), seams_(seams) {}

  void add(const Triangle& t) {
    const std::uint32_t a = patch(t[0]);
    const std::uint32_t b = patch(t[1]);
    const std::uint32_t c = patch(t[2]);
    if (a == b && b == c) {
      put(a, node(t[0]), node(t[1]), node(t[2]));
    } else if (b == c) {
      add_between(t[0], t[1], t[2]);
    } else if (c == a) {
      add_between(t[1], t[2], t[0]);
    } else if (a == b) {
      add_between(t[2], t[0], t[1]);
    } else {
      add_junction(t);
    }
  }

 private:
  [[nodiscard]] std::uint32_t patch(std::uint32_t v) const { return vertices_[v].patch; }
  [[nodiscard]] std::uint32_t node(std::uint32_t v) const { return vertices_[v].node; }
  void put(std::uint32_t patch, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    seams_.triangles[patch].push_back({a, b, c});
  }

  /// The corner at the seam vertex between two border vertices.
  std::uint32_t seam(std::uint32_t a, std::uint32_t b) {
    if (a > b) std::swap(a, b);
    const auto next = static_cast<std::uint32_t>(seams_.vertices.size());
    const std::uint32_t number = seams_of_edges_.insert((std::uint64_t{a} << 32U) | b, next);
    if (number == next)
      seams_.vertices.push_back({seam_position(vertices_[a], vertices_[b]), patch(a)});
    return number | kSeamVertexBit;
  }

  /// One corner of a patch, two of another.
  void add_between(std::uint32_t single, std::uint32_t next, std::uint32_t last) {
    const std::uint32_t to_next = seam(single, next);
    const std::uint32_t to_last = seam(single, last);
    put(patch(single), node(single), to_next, to_last);
    const auto at = [&](std::uint32_t corner) {
      return seams_.vertices[corner & ~kSeamVertexBit].position;
    };
    // The quadrangle to_next, next, last, to_last along its shorter diagonal.
    if (glm::distance(at(to_next), vertices_[last].position) <
        glm::distance(at(to_last), vertices_[next].position)) {
      put(patch(next), to_next, node(next), node(last));
      put(patch(next), to_next, node(last), to_last);
    } else {
      put(patch(next), to_next, node(next), to_last);
      put(patch(next), node(next), node(last), to_last);
    }
  }

  /// Three patches meet at a vertex within the triangle.
  void add_junction(const Triangle& t) {
    std::array<std::uint32_t, 3> seams{};
    glm::dvec3 middle(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      seams[k] = seam(t[k], t[(k + 1) % 3]);
      middle += seams_.vertices[seams[k] & ~kSeamVertexBit].position / 3.0;
    }
    const BorderVertex& a = vertices_[t[0]];
    const BorderVertex& b = vertices_[t[1]];
    const BorderVertex& c = vertices_[t[2]];
    const glm::dvec3 offset = to_creases(a, b, c, middle);
    if (glm::length(offset) <= kCreaseReach * std::max({a.spacing, b.spacing, c.spacing}))
      middle += offset;
    const auto junction = static_cast<std::uint32_t>(seams_.vertices.size()) | kSeamVertexBit;
    seams_.vertices.push_back({middle, patch(t[0])});
    for (std::size_t k = 0; k < 3; ++k) {
      put(patch(t[k]), node(t[k]), seams[k], junction);
      put(patch(t[k]), node(t[k]), junction, seams[(k + 2) % 3]);
    }
  }

  const std::vector<BorderVertex>& vertices_;
  Seams& seams_;
  FlatMap seams_of_edges_;
};

}  // namespace

glm::dvec3 seam_position(const BorderVertex& a, const BorderVertex& b) {
  const glm::dvec3 d = b.position - a.position;
  const glm::dvec3 middle = 0.5 * (a.position + b.position);
  if (meet_at_crease(a, b)) {
    const glm::dvec3 offset = to_crease(plane_of(a), plane_of(b), middle);
    const double most = reach_between(a, b);
    return middle + offset * std::min(1.0, most / std::max(glm::length(offset), 1e-300));
  }
  return middle + 0.125 * (glm::dot(d, b.normal) * b.normal - glm::dot(d, a.normal) * a.normal);
}

void share_out(std::span<const Triangle> triangles, const BorderMesh& mesh, Seams& seams) {
  Sharing sharing(mesh, seams);
  for (const Triangle& t : triangles) sharing.add(t);
}

}  // namespace relief
