// The triangle of three points, as surfels take their sizes from it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace relief {

/// The ratio of the eigenvalues lambda_1 to lambda_2 of three points' covariance, below which they
/// count as collinear: 1 is an equilateral triangle. The surface variation of [Textured surfels]
/// cannot tell: it is 0 for any three points. The diameter of the circumscribed circle is at most
/// three times the longest edge.
inline constexpr double kLeastEigenvalueRatio = 0.01;

/// Three points by their squared edges.
struct SurfelTriangle {
  std::array<double, 3> squared_edges{};
  double twice_area = 0.0;

  SurfelTriangle(glm::dvec3 a, glm::dvec3 b, glm::dvec3 c)
      : squared_edges{glm::dot(b - a, b - a), glm::dot(c - b, c - b), glm::dot(a - c, a - c)},
        twice_area(glm::length(glm::cross(b - a, c - a))) {}

  /// From the scatter matrix of three points: its eigenvalues' sum is a third of the squared edges'
  /// sum, their product a third of the squared doubled area.
  [[nodiscard]] double eigenvalue_ratio() const {
    const double sum = (squared_edges[0] + squared_edges[1] + squared_edges[2]) / 3.0;
    const double product = twice_area * twice_area / 3.0;
    const double larger = 0.5 * (sum + std::sqrt(std::max(sum * sum - 4.0 * product, 0.0)));
    return larger > 0.0 ? product / (larger * larger) : 0.0;
  }
  [[nodiscard]] bool is_collinear() const { return !(eigenvalue_ratio() >= kLeastEigenvalueRatio); }

  [[nodiscard]] double mean_edge() const {
    return (std::sqrt(squared_edges[0]) + std::sqrt(squared_edges[1]) +
            std::sqrt(squared_edges[2])) /
           3.0;
  }
  /// Of points that are not collinear.
  [[nodiscard]] double circle_diameter() const {
    return std::sqrt(squared_edges[0] * squared_edges[1] * squared_edges[2]) / twice_area;
  }
};

}  // namespace relief
