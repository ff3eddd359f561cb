// Whether the points of a patch support a sample at a place of its base plane.
#pragma once

#include <cstdint>
#include <vector>

#include "preprocess/resample/support.h"

namespace relief {

/// True if the points of `lookup` support a sample at (x, y): one lies within 0.9 spacings on the
/// base plane; or, in sparse spots, those around surround it closely enough to interpolate between
/// them. So borders are extrapolated by less than one spacing, and gaps wider than about three
/// local spacings stay gaps.
[[nodiscard]] bool is_supported(const PatchPoints& points, const PointGrid& lookup, double x,
                                double y, double spacing);

/// The same of the nodes of a grid, at a fraction of the price where most of them are to be asked.
/// Each point tells the nodes around it in which eighth of a turn they see it. In the midst of the
/// points and away from them that decides; only nodes along borders are looked at more closely.
class NodeSupport {
 public:
  /// All three must outlive this; `lookup` is over `points`.
  NodeSupport(const PatchPoints& points, const PointGrid& lookup, const PatchGrid& grid);

  [[nodiscard]] bool is_supported(std::uint32_t i, std::uint32_t j) const;

 private:
  /// Calls fn(octants, i, j, dx, dy), the last two of the way from the node to the point, for the
  /// nodes within `radius` of it on the base plane that have not all octants yet.
  template <class Fn>
  void for_nodes_within(glm::dvec3 point, double radius, const Fn& fn);
  /// True only if a few nodes beside each other all have all octants.
  [[nodiscard]] bool have_all_octants(std::size_t begin, std::size_t end) const;

  const PatchPoints& points_;
  const PointGrid& lookup_;
  const PatchGrid& grid_;
  std::vector<std::uint8_t> octants_;  ///< of each node a bit for each eighth of a turn; then
                                       ///< some of none, so that eight can be read at once
  double widest_reach_ = 0.0;
};

}  // namespace relief
