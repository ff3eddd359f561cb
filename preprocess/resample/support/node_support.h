// Tests whether points support a sample at a position of a patch's base plane.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/resample/support/patch_grid.h"

namespace relief {

/// A node within this many grid spacings of a point is always supported, so that a border moves
/// outward by less than one spacing.
inline constexpr double kReachInSpacings = 0.9;

/// Returns whether the points of `lookup` support a sample at (x, y): one lies within 0.9 spacings
/// on the base plane, or, in sparse parts, points surround it closely enough to interpolate.
/// So borders are extrapolated by less than one spacing, and gaps wider than about three local
/// spacings stay gaps.
[[nodiscard]] bool is_supported(const PatchPoints& points, const PointGrid& lookup, double x,
                                double y, double spacing);

/// Returns whether they surround it.
[[nodiscard]] bool is_surrounded(const PatchPoints& points, const PointGrid& lookup, double x,
                                 double y, double spacing);

/// Tests the support of a grid's nodes, much faster if most nodes are tested. Each point marks, at
/// the nodes around it, the octant of directions in which it lies. This decides nodes amid points
/// and far from them; only nodes along borders need the full test.
class NodeSupport {
 public:
  /// All three must outlive this; `lookup` is over `points`.
  NodeSupport(const PatchPoints& points, const PointGrid& lookup, const PatchGrid& grid);

  /// The support by more points: those of `lookup`, of which the first are those of `fewer`.
  NodeSupport(const NodeSupport& fewer, const PointGrid& lookup);

  [[nodiscard]] bool is_supported(std::uint32_t i, std::uint32_t j) const;

 private:
  /// Calls fn(octants, i, j, dx, dy), with (dx, dy) from the node to the point, for the nodes
  /// within `radius` of the point on the base plane that lack an octant.
  template <class Fn>
  void for_nodes_within(glm::dvec3 point, double radius, const Fn& fn);
  /// Adds the points of `lookup_` from this one on.
  void add_points(std::uint32_t first);
  /// Returns true only if some adjacent nodes have all octants.
  [[nodiscard]] bool have_all_octants(std::size_t begin, std::size_t end) const;

  const PatchPoints& points_;
  const PointGrid& lookup_;
  const PatchGrid& grid_;
  std::vector<std::uint8_t> octants_;  ///< a bit for each octant, for each node; padded, so that
                                       ///< eight can be read at once
  double widest_reach_ = 0.0;
};

}  // namespace relief
