// Where a scan that is larger than memory is cut into tiles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"

namespace relief {

/// A part of space, half open, infinite where the scan ends; and how far around it points are
/// needed so that its own are neighboured as in the whole scan, world units.
struct Tile {
  Bounds region;
  double halo = 0.0;
};

/// A kd-tree whose leaves are tiles.
struct TileLayout {
  /// What is below a cut is left, the rest right: another cut, or a tile (~ its number).
  struct Cut {
    std::int32_t axis = 0;
    std::int32_t left = 0;
    std::int32_t right = 0;
    double at = 0.0;
  };

  std::vector<Cut> cuts;  ///< the first is the root; none: one tile
  std::vector<Tile> tiles;
  double largest_halo = 0.0;

  [[nodiscard]] std::uint32_t tile_of(glm::dvec3 point) const;
  /// The tile of a finer layout's tile: the one that it lies in if that layout's cuts are these
  /// and more.
  [[nodiscard]] std::uint32_t tile_about(const Tile& finer) const;
  /// The tiles in whose halo a point is that is in `own`.
  void find_halos(glm::dvec3 point, std::uint32_t own, std::vector<std::uint32_t>& found) const;

 private:
  void find_halos_below(std::int32_t node, glm::dvec3 point, std::uint32_t own,
                        std::vector<std::uint32_t>& found) const;
};

/// Every so many-th point of a scan, enough of them to see how it is spread.
class PointSample {
 public:
  void add(glm::dvec3 point);

  [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
  /// Each stands for so many.
  [[nodiscard]] std::uint64_t stride() const { return stride_; }

 private:
  std::vector<glm::dvec3> points_;
  std::uint64_t stride_ = 1;
  std::uint64_t seen_ = 0;
};

/// Cuts at medians, across the longest side of what most points are in, until no tile has more than
/// about `tile_points` of the scan's points. Halos are as wide as a patch's margin, its fits and
/// neighbourhoods reach at the scan's local spacing, or at the grid's (0: not known).
[[nodiscard]] TileLayout lay_tiles(const PointSample& sample, std::uint64_t tile_points,
                                   double grid_spacing);

/// The same cuts, but those whose tiles have, with `load` of each tile, no more than `most`
/// together: these are one tile. Halos are as lay_tiles makes them for that spacing.
[[nodiscard]] TileLayout coarser_layout(const TileLayout& layout, std::span<const double> load,
                                        double most, double grid_spacing);

}  // namespace relief
