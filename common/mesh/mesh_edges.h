// The edges of a mesh, with the triangles at each edge.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// Of edges that triangles traverse alike: a mesh with fewer is oriented. Real meshes have a few at
/// spots that are no manifold; in a soup half of all are.
inline constexpr double kMaxMisoriented = 0.05;

/// An edge as traversed by one triangle.
struct EdgeUse {
  std::uint32_t greater = 0;  ///< of the edge's two points
  std::uint32_t triangle = 0;
  bool forward = false;  ///< from the smaller index to the greater
};

/// All edges of a mesh with valid indices. Built in parallel; the result does not depend on the
/// number of threads.
class MeshEdges {
 public:
  explicit MeshEdges(const Points& mesh) : MeshEdges(mesh.size(), mesh.triangles) {}
  /// Of triangles of the first `points` points.
  MeshEdges(std::size_t points, std::span<const Triangle> triangles);

  /// Returns the edges whose smaller index is this point; uses of one edge are adjacent, in the
  /// triangles' order.
  [[nodiscard]] std::span<const EdgeUse> of(std::uint32_t lesser) const {
    return std::span(uses_).subspan(starts_[lesser], starts_[lesser + 1] - starts_[lesser]);
  }

  /// Calls `visit(lesser point, uses)` for each edge, in the order of their points.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::uint32_t p = 0; p + 1 < starts_.size(); ++p) {
      const std::span<const EdgeUse> uses = of(p);
      for (std::size_t first = 0, end = 0; first < uses.size(); first = end) {
        while (end < uses.size() && uses[end].greater == uses[first].greater) ++end;
        visit(p, uses.subspan(first, end - first));
      }
    }
  }

  /// Calls `visit(lesser point, use, other use)` for the edges of exactly two uses.
  template <class Visit>
  void for_each_of_two(const Visit& visit) const {
    for_each([&visit](std::uint32_t p, std::span<const EdgeUse> uses) {
      if (uses.size() == 2) visit(p, uses[0], uses[1]);
    });
  }

  /// Returns whether each edge belongs to exactly two triangles, which traverse it in opposite
  /// directions.
  [[nodiscard]] bool all_have_two() const { return all_have_two_; }

  /// Returns whether some edge belongs to one triangle alone.
  [[nodiscard]] bool has_border() const { return has_border_; }

  /// Returns the share of an edge's further triangles that traverse it in the direction of its
  /// first one: 0 for an oriented mesh; 1 if no edge has two triangles.
  [[nodiscard]] double misoriented() const { return misoriented_; }

 private:
  std::vector<std::uint64_t> starts_;  // of each smaller index in uses_, with an end
  std::vector<EdgeUse> uses_;
  bool all_have_two_ = true;
  bool has_border_ = false;
  double misoriented_ = 1.0;
};

}  // namespace relief
