// The border that stitching moves: edges that have a triangle on one side.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <utility>
#include <vector>

#include "common/flat_map.h"
#include "common/points.h"
#include "common/seams/border_mesh.h"

namespace relief {

/// Directions about a position, as numbers from 0 to 4 that grow with the angle from a first one,
/// counterclockwise about a normal.
class AnglesAbout {
 public:
  AnglesAbout(glm::dvec3 middle, glm::dvec3 normal, glm::dvec3 first);
  [[nodiscard]] double to(glm::dvec3 position) const;

 private:
  glm::dvec3 middle_;
  glm::dvec3 x_;
  glm::dvec3 y_;
};

/// A triangle's size and normal. NaN and infinite where it has no area.
struct TriangleShape {
  glm::dvec3 normal{0.0};  ///< unit
  double area = 0.0;       ///< twice the triangle's
  double radius = 0.0;     ///< of the circumscribed circle
};

[[nodiscard]] TriangleShape shape_of(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c);

/// The border edges of a mesh and the triangles added to it. An edge leads from one vertex to
/// another and has its triangle on the left, seen from outside. `mesh` must outlive it.
class Front {
 public:
  using Vertex = std::uint32_t;

  /// A border edge at one of its ends.
  struct Edge {
    Vertex other = 0;
    bool outward = false;    ///< from the vertex to the other
    glm::dvec3 normal{0.0};  ///< of its triangle
  };

  explicit Front(const BorderMesh& mesh);

  [[nodiscard]] const BorderMesh& mesh() const { return mesh_; }
  [[nodiscard]] const std::vector<BorderVertex>& vertices() const { return vertices_; }
  [[nodiscard]] const BorderVertex& vertex(Vertex v) const { return vertices_[v]; }
  [[nodiscard]] std::span<const Edge> at(Vertex v) const { return corners_[v].edges; }

  /// Whether a vertex can be a corner of another triangle: it is at the border, or nothing reaches
  /// it. If it cannot, it never can again.
  [[nodiscard]] bool is_live(Vertex v) const {
    return !corners_[v].edges.empty() || !corners_[v].has_triangle;
  }

  /// At least as long as each border edge at a vertex, and at any vertex.
  [[nodiscard]] double longest_at(Vertex v) const { return corners_[v].longest; }
  [[nodiscard]] double longest() const { return longest_; }

  /// The border edge between two vertices, or null. It is good until the border moves.
  [[nodiscard]] const Edge* find(Vertex from, Vertex to) const;
  [[nodiscard]] bool is_open(Vertex from, Vertex to) const { return find(from, to) != nullptr; }

  /// Whether some triangle has that edge on its left, at the border or not.
  [[nodiscard]] bool is_used(Vertex from, Vertex to) const;

  /// Adds the triangle to, from, apex on the border edge from `from` to `to`.
  void attach(Vertex from, Vertex to, Vertex apex);

  /// The triangles that were added.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  [[nodiscard]] std::vector<Triangle> take() { return std::move(triangles_); }

 private:
  void open(Vertex from, Vertex to, glm::dvec3 normal);
  void close(Vertex from, Vertex to);

  /// What is known of a vertex, in one cache line: most of the time goes into reading these.
  struct alignas(64) Corner {
    std::vector<Edge> edges;       ///< of the border
    double longest = 0.0;          ///< of those that ever were in it
    std::uint32_t first_used = 0;  ///< in used_: edges of the mesh that lead from here
    std::uint32_t end_used = 0;
    bool has_triangle = false;
    bool has_added = false;  ///< edges of added triangles lead from here: they are in added_
  };

  void use(Vertex from, Vertex to);

  const BorderMesh& mesh_;
  const std::vector<BorderVertex>& vertices_;
  std::vector<Corner> corners_;
  double longest_ = 0.0;
  std::vector<Vertex> used_;
  FlatMap added_;
  std::vector<Triangle> triangles_;
};

}  // namespace relief
