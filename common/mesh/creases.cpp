#include "common/mesh/creases.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <span>

#include "common/disjoint_sets.h"
#include "common/mesh/mesh_edges.h"

namespace relief {
namespace {

constexpr std::uint32_t kNone = UINT32_MAX;

/// Of each triangle, twice its area times its unit normal.
std::vector<glm::dvec3> area_normals(const Points& mesh) {
  std::vector<glm::dvec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t[0]];
    normals.push_back(glm::cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a));
  }
  return normals;
}

/// Calls `visit(use, other use, lesser point)` for the edges that are no creases. Triangles that
/// traverse an edge alike face opposite sides, and have a crease there.
template <class Visit>
void for_each_smooth_edge(const Points& mesh, const std::vector<glm::dvec3>& normals,
                          const Visit& visit) {
  const MeshEdges edges(mesh);
  for (std::uint32_t p = 0; p < mesh.size(); ++p) {
    const std::span<const EdgeUse> uses = edges.of(p);
    for (std::size_t e = 0; e + 1 < uses.size(); ++e) {
      const EdgeUse& a = uses[e];
      const EdgeUse& b = uses[e + 1];
      if (a.greater != b.greater || a.forward == b.forward) continue;
      const glm::dvec3 n = normals[a.triangle];
      const glm::dvec3 m = normals[b.triangle];
      if (glm::dot(n, m) >= kCreaseCosine * glm::length(n) * glm::length(m)) visit(a, b, p);
    }
  }
}

struct Crease {
  std::uint32_t lesser = 0;
  std::uint32_t greater = 0;
};

/// Finds the creases, and counts the edges that could be one.
std::vector<Crease> find_creases(const Points& mesh, std::size_t& edge_count) {
  const std::vector<glm::dvec3> normals = area_normals(mesh);
  std::vector<Crease> creases;
  MeshEdges(mesh).for_each_of_two([&](std::uint32_t p, const EdgeUse& a, const EdgeUse& b) {
    const glm::dvec3 n = normals[a.triangle];
    const glm::dvec3 m = a.forward != b.forward ? normals[b.triangle] : -normals[b.triangle];
    const double lengths = glm::length(n) * glm::length(m);
    if (!(lengths > 0.0)) return;
    ++edge_count;
    if (glm::dot(n, m) < kCreaseCosine * lengths) creases.push_back({p, a.greater});
  });
  return creases;
}

/// Corners are numbered triangle by triangle.
std::uint32_t corner_at(const Points& mesh, std::uint32_t triangle, std::uint32_t point) {
  const Triangle& t = mesh.triangles[triangle];
  return 3 * triangle + (t[0] == point ? 0 : t[1] == point ? 1 : 2);
}

/// The corners of a point that lie, from triangle to triangle, on one side of creases.
DisjointSets join_corners(const Points& mesh, const std::vector<glm::dvec3>& normals) {
  DisjointSets corners(3 * mesh.triangles.size());
  for_each_smooth_edge(mesh, normals, [&](const EdgeUse& a, const EdgeUse& b, std::uint32_t p) {
    for (const std::uint32_t end : {p, a.greater})
      corners.join(corner_at(mesh, a.triangle, end), corner_at(mesh, b.triangle, end));
  });
  return corners;
}

/// The angle of a triangle at a corner, radians.
double angle_at(const Points& mesh, const Triangle& t, std::size_t c) {
  const glm::dvec3 p = mesh.positions[t[c]];
  const glm::dvec3 u = mesh.positions[t[(c + 1) % 3]] - p;
  const glm::dvec3 v = mesh.positions[t[(c + 2) % 3]] - p;
  return std::atan2(glm::length(glm::cross(u, v)), glm::dot(u, v));
}

/// Gives each set of corners a point of its own: the first set of a point keeps that.
void split(DisjointSets& corners, Points& mesh) {
  std::vector<std::uint32_t> point_of(3 * mesh.triangles.size(), kNone);
  std::vector<std::uint8_t> is_taken(mesh.size(), 0);
  for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
    for (std::uint32_t c = 0; c < 3; ++c) {
      const std::uint32_t old = mesh.triangles[k][c];
      std::uint32_t& point = point_of[corners.find(3 * k + c)];
      if (point == kNone && is_taken[old] == 0) {
        point = old;
        is_taken[old] = 1;
      } else if (point == kNone) {
        point = static_cast<std::uint32_t>(mesh.size());
        repeat_point(mesh, old);
      }
      mesh.triangles[k][c] = point;
    }
  }
}

}  // namespace

CreaseCensus count_creases(const Points& mesh) {
  CreaseCensus census;
  const std::vector<Crease> creases = find_creases(mesh, census.edges);
  census.creases = creases.size();
  std::vector<std::uint32_t> creases_at(mesh.size(), 0);
  for (const Crease& c : creases) {
    ++creases_at[c.lesser];
    ++creases_at[c.greater];
  }
  for (const Crease& c : creases) {
    census.ends_in_lines +=
        (creases_at[c.lesser] == 2 ? 1U : 0U) + (creases_at[c.greater] == 2 ? 1U : 0U);
  }
  return census;
}

std::vector<std::uint32_t> sides_of_triangles(const Points& mesh) {
  DisjointSets sets(mesh.triangles.size());
  for_each_smooth_edge(mesh, area_normals(mesh),
                       [&](const EdgeUse& a, const EdgeUse& b, std::uint32_t /*lesser*/) {
                         sets.join(a.triangle, b.triangle);
                       });
  std::vector<std::uint32_t> sides;
  sides.reserve(mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) sides.push_back(sets.find(t));
  return sides;
}

void split_at_creases(Points& mesh) {
  const std::vector<glm::dvec3> of_triangles = area_normals(mesh);
  DisjointSets corners = join_corners(mesh, of_triangles);
  split(corners, mesh);
  std::vector<glm::dvec3> sums(mesh.size(), glm::dvec3(0.0));
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) {
    const Triangle& t = mesh.triangles[k];
    for (std::size_t c = 0; c < 3; ++c) sums[t[c]] += angle_at(mesh, t, c) * of_triangles[k];
  }
  mesh.normals.assign(mesh.size(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double length = glm::length(sums[i]);
    if (length > 0.0) mesh.normals[i] = glm::vec3(sums[i] / length);
  }
}

}  // namespace relief
