// Which triangles may be added to a border, and which of them first.
#pragma once

#include <optional>

#include "common/seams/stitching/front.h"
#include "common/seams/vertex_grid.h"

namespace relief {

/// A triangle that could be added on a border edge from `from` to `to`.
struct GrowthCandidate {
  double score = 0.0;  ///< smaller is better
  Front::Vertex from = 0;
  Front::Vertex to = 0;
  Front::Vertex apex = 0;
};

/// What stitching asks of triangles, as the border is now. Several threads may ask at once while
/// nothing is added.
class GrowthRules {
 public:
  using Vertex = Front::Vertex;

  /// `grid`: of all vertices that are live. Both must outlive it.
  GrowthRules(const Front& front, const VertexGrid& grid) : front_(front), grid_(grid) {}

  /// How good the triangle to, from, apex is: smaller is better; nothing if it is none.
  [[nodiscard]] std::optional<double> score_of(Vertex from, Vertex to, Vertex apex) const;

  /// Whether a triangle covers no vertex and crosses no border edge of its sheet.
  [[nodiscard]] bool is_free(Vertex from, Vertex to, Vertex apex) const;

  /// What `score_of` and `is_free` say of a triangle depends on vertices that are near it: no
  /// farther from a position than this and half their longest edge.
  struct Surroundings {
    glm::dvec3 middle{0.0};
    double radius = 0.0;
  };
  [[nodiscard]] Surroundings surroundings_of(Vertex from, Vertex to, Vertex apex) const;

  /// The best triangle on a border edge, if there is one.
  [[nodiscard]] std::optional<GrowthCandidate> best_on(Vertex from, Vertex to) const;

 private:
  const Front& front_;
  const VertexGrid& grid_;
};

}  // namespace relief
