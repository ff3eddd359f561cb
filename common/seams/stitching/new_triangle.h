// A triangle that stitching may add, and what lies over it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/cross.h"
#include "common/seams/crease_between.h"
#include "common/seams/stitching/front.h"

namespace relief {

/// A triangle that may be added, and what lies over it: seen along its normal, or at an edge from
/// where both faces are.
class NewTriangle {
 public:
  using Vertex = Front::Vertex;

  /// The corners: to, from, apex.
  NewTriangle(const Front& front, Vertex from, Vertex to, Vertex apex)
      : front_(front), corners_{to, from, apex}, sheet_(kSheet * front.vertex(from).spacing) {
    for (std::size_t k = 0; k < 3; ++k) p_[k] = front.vertex(corners_[k]).position;
    n_ = glm::normalize(glm::cross(p_[1] - p_[0], p_[2] - p_[0]));
    if (const auto outward =
            outward_at_edge(front.vertex(to), front.vertex(from), front.vertex(apex))) {
      n_ = *outward;
      // Faces are steep from there.
      sheet_ /= std::max(glm::dot(n_, front.vertex(from).normal), kSteepestFace);
    }
    x_ = p_[1] - p_[0];
    x_ = glm::normalize(x_ - glm::dot(x_, n_) * n_);
    y_ = glm::cross(n_, x_);
    for (std::size_t k = 0; k < 3; ++k) t_[k] = flat(p_[k]);
    middle_ = (p_[0] + p_[1] + p_[2]) / 3.0;
    for (const glm::dvec3& q : p_) reach_ = std::max(reach_, glm::distance(q, middle_));
  }

  [[nodiscard]] glm::dvec3 middle() const { return middle_; }

  /// All corners are within this of the middle.
  [[nodiscard]] double reach() const { return reach_; }

  /// What is farther than this from the middle is not over the triangle on its sheet. A little
  /// more, for rounding.
  [[nodiscard]] double over() const { return 1.001 * std::sqrt(reach_ * reach_ + sheet_ * sheet_); }

  [[nodiscard]] bool has_corner(Vertex v) const {
    return std::ranges::find(corners_, v) != corners_.end();
  }

  /// Whether a vertex is on this side.
  [[nodiscard]] bool faces(Vertex v) const { return glm::dot(front_.vertex(v).normal, n_) > 0.0; }

  [[nodiscard]] bool covers(Vertex v) const {
    const glm::dvec3 position = front_.vertex(v).position;
    if (!(std::abs(glm::dot(position - p_[0], n_)) < sheet_)) return false;
    const glm::dvec2 q = flat(position);
    return cross(t_[1] - t_[0], q - t_[0]) > 0.0 && cross(t_[2] - t_[1], q - t_[1]) > 0.0 &&
           cross(t_[0] - t_[2], q - t_[2]) > 0.0;
  }

  /// Whether the edge v, w crosses one of the triangle's two new edges.
  [[nodiscard]] bool crosses(Vertex v, Vertex w) const {
    const glm::dvec3 begin = front_.vertex(v).position;
    const glm::dvec3 end = front_.vertex(w).position;
    const glm::dvec2 q = flat(begin);
    const glm::dvec2 r = flat(end);
    for (const std::size_t side : {1U, 2U}) {
      const std::size_t next = (side + 1) % 3;
      if (w == corners_[side] || w == corners_[next]) continue;
      const double s0 = cross(t_[next] - t_[side], q - t_[side]);
      const double s1 = cross(t_[next] - t_[side], r - t_[side]);
      const double u0 = cross(r - q, t_[side] - q);
      const double u1 = cross(r - q, t_[next] - q);
      if (s0 * s1 >= 0.0 || u0 * u1 >= 0.0) continue;
      const glm::dvec3 at = glm::mix(begin, end, s0 / (s0 - s1));
      if (std::abs(glm::dot(at - p_[0], n_)) < sheet_) return true;
    }
    return false;
  }

 private:
  // What is farther than this from a triangle's plane, in spacings, is another sheet.
  static constexpr double kSheet = 0.6;
  // The cosine below which faces of a sharp edge count as no steeper: that of half a wedge of 35
  // degrees.
  static constexpr double kSteepestFace = 0.3;

  [[nodiscard]] glm::dvec2 flat(glm::dvec3 q) const {
    return {glm::dot(q - p_[0], x_), glm::dot(q - p_[0], y_)};
  }

  const Front& front_;
  std::array<Vertex, 3> corners_;
  double sheet_;
  std::array<glm::dvec3, 3> p_{};
  std::array<glm::dvec2, 3> t_{};  ///< in the triangle's plane
  glm::dvec3 n_{0.0};
  glm::dvec3 x_{0.0};
  glm::dvec3 y_{0.0};
  glm::dvec3 middle_{0.0};
  double reach_ = 0.0;
};

}  // namespace relief
