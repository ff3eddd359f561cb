// The border that stitching moves: edges that have a triangle on one side.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <unordered_set>
#include <utility>
#include <vector>

#include "common/points.h"
#include "common/seams/border_mesh.h"

namespace relief {

/// Directions about a vertex, as numbers from 0 to 4 that grow with the angle from a first one,
/// counterclockwise about its normal.
class AnglesAbout {
 public:
  AnglesAbout(const BorderVertex& middle, glm::dvec3 first);
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
  [[nodiscard]] std::span<const Edge> at(Vertex v) const { return at_[v]; }
  [[nodiscard]] bool has_triangle(Vertex v) const { return has_triangle_[v] != 0; }

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

  const BorderMesh& mesh_;
  const std::vector<BorderVertex>& vertices_;
  std::vector<std::vector<Edge>> at_;
  std::vector<std::uint8_t> has_triangle_;
  std::unordered_set<std::uint64_t> used_;
  std::vector<Triangle> triangles_;
};

}  // namespace relief
