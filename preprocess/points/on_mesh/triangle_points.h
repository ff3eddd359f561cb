// Points on the triangles of a mesh, about equally far apart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "common/flat_map.h"
#include "common/mesh/triangle_order.h"
#include "common/points.h"

namespace relief {

/// Goes through the points of a mesh's triangles, except their corners: those on edges, and within
/// triangles those of rows parallel to the longest edge, wherever a triangle begins. Its corners
/// and their weights say where each point is. Hostile lengths are cut into no more than 4096
/// pieces.
class TrianglePoints {
 public:
  /// About `step` apart, world units. Edges up to `longest_left_alone` get none, nor do triangles
  /// without a longer edge.
  TrianglePoints(const Points& mesh, double longest_left_alone, double step)
      : mesh_(mesh), longest_left_alone_(longest_left_alone), step_(step) {}

  /// Returns a number of points that a triangle does not have more of, edges included.
  [[nodiscard]] double most_on(std::size_t triangle) const {
    const Triangle& t = mesh_.triangles[triangle];
    const std::array lengths{length_of(t, 0), length_of(t, 1), length_of(t, 2)};
    const double longest = *std::ranges::max_element(lengths);
    if (longest <= longest_left_alone_) return 0.0;
    double sum = 0.0;
    for (const double length : lengths) sum += count_pieces(length) - 1;
    const glm::dvec3 first = mesh_.positions[t[0]];
    const double twice_area =
        glm::length(glm::cross(mesh_.positions[t[1]] - first, mesh_.positions[t[2]] - first));
    const int rows = count_pieces(twice_area / longest);
    return sum + static_cast<double>(rows) * count_pieces(longest);
  }

  /// Calls `add(triangle, weights)` for the points of a triangle's edges that no earlier one had.
  /// Ends when that returns false, and returns whether it never did; so does the next one.
  template <class Add>
  bool on_edges(std::size_t triangle, const Add& add) {
    const Triangle t = smallest_first(mesh_.triangles[triangle]);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = std::min(t[c], t[(c + 1) % 3]);
      const std::uint32_t b = std::max(t[c], t[(c + 1) % 3]);
      const double length = length_of(t, c);
      if (length <= longest_left_alone_ || !is_first(a, b)) continue;
      const int pieces = count_pieces(length);
      for (int i = 1; i < pieces; ++i) {
        const double s = static_cast<double>(i) / pieces;
        if (!add(Triangle{a, b, b}, glm::dvec3(1.0 - s, s, 0.0))) return false;
      }
    }
    return true;
  }

  template <class Add>
  bool within(std::size_t triangle, const Add& add) const {
    const Triangle t = smallest_first(mesh_.triangles[triangle]);
    std::size_t longest = 0;
    for (std::size_t c = 1; c < 3; ++c) {
      if (length_of(t, c) > length_of(t, longest)) longest = c;
    }
    const double length = length_of(t, longest);
    if (length <= longest_left_alone_) return true;
    const Triangle turned{t[longest], t[(longest + 1) % 3], t[(longest + 2) % 3]};
    const glm::dvec3 base = mesh_.positions[turned[1]] - mesh_.positions[turned[0]];
    const glm::dvec3 side = mesh_.positions[turned[2]] - mesh_.positions[turned[0]];
    const int rows = count_pieces(glm::length(glm::cross(base, side)) / length);
    for (int row = 1; row < rows; ++row) {
      const double up = static_cast<double>(row) / rows;
      const int pieces = count_pieces(length * (1.0 - up));
      for (int i = 1; i < pieces; ++i) {
        const double s = (1.0 - up) * i / pieces;
        if (!add(turned, glm::dvec3(1.0 - up - s, s, up))) return false;
      }
    }
    return true;
  }

 private:
  /// Whether this is the first call with an edge.
  bool is_first(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t number = edges_++;
    return edges_done_.insert(std::uint64_t{a} << 32U | b, number) == number;
  }

  /// Of the edge from a corner to the next.
  [[nodiscard]] double length_of(const Triangle& t, std::size_t corner) const {
    return glm::distance(mesh_.positions[t[corner]], mesh_.positions[t[(corner + 1) % 3]]);
  }
  [[nodiscard]] int count_pieces(double length) const {
    return static_cast<int>(std::min(length / step_, 4095.0)) + 1;
  }

  const Points& mesh_;
  double longest_left_alone_;
  double step_;
  FlatMap edges_done_;  ///< in the order that they were asked about
  std::uint32_t edges_ = 0;
};

/// Appends a point of a mesh's triangle to `points`, with attributes that are interpolated; labels
/// are the nearest corner's. `points` may be the mesh itself.
void append_point(const Points& mesh, const Triangle& t, glm::dvec3 weights, Points& points);

}  // namespace relief
