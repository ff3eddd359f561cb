// The edges of a mesh with the triangles at each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/points.h"

namespace relief {

/// An edge as one triangle runs through it.
struct EdgeUse {
  std::uint32_t greater = 0;  ///< of its two points
  std::uint32_t triangle = 0;
  bool forward = false;  ///< from the lesser point to the greater
};

/// All edges of a mesh whose triangles name points that it has. Built on all cores; the same with
/// any number of them.
class MeshEdges {
 public:
  explicit MeshEdges(const Points& mesh);

  /// Those whose lesser point this is: the uses of one edge beside each other, in the triangles'
  /// order.
  [[nodiscard]] std::span<const EdgeUse> of(std::uint32_t lesser) const {
    return std::span(uses_).subspan(starts_[lesser], starts_[lesser + 1] - starts_[lesser]);
  }

  /// Whether each is one of exactly two triangles, which run through it in opposite directions.
  [[nodiscard]] bool all_have_two() const { return all_have_two_; }

  /// Of the triangles that came to an edge after its first one, the share of those that run through
  /// it in the first one's direction: 0 on an oriented mesh; 1 if no edge has two.
  [[nodiscard]] double misoriented() const { return misoriented_; }

 private:
  std::vector<std::uint64_t> starts_;  // of each lesser point in uses_, with an end
  std::vector<EdgeUse> uses_;
  bool all_have_two_ = true;
  double misoriented_ = 1.0;
};

}  // namespace relief
