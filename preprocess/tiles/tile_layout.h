// Cuts scans larger than memory into tiles.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "common/bounds.h"
#include "common/error.h"

namespace relief {

/// A half-open box, infinite where the scan ends, and the width of its halo, in the points' unit
/// and frame: with the points of the halo, own points have the neighbourhoods that they have in the
/// whole scan.
struct Tile {
  Bounds region;
  double halo = 0.0;
};

/// A kd-tree whose leaves are tiles.
struct TileLayout {
  /// Child below the cut (left) or at and above it (right): another cut, or a tile (~ its index).
  struct Cut {
    std::int32_t axis = 0;
    std::int32_t left = 0;
    std::int32_t right = 0;
    double at = 0.0;
  };

  std::vector<Cut> cuts;  ///< the first is the root; empty: one tile
  std::vector<Tile> tiles;
  double largest_halo = 0.0;

  [[nodiscard]] std::uint32_t tile_of(glm::dvec3 point) const;
  /// Returns the tile that contains a tile of a finer layout, if that layout's cuts extend these.
  [[nodiscard]] std::uint32_t tile_about(const Tile& finer) const;
  /// Returns the tiles in whose halo a point of tile `own` lies.
  void find_halos(glm::dvec3 point, std::uint32_t own, std::vector<std::uint32_t>& found) const;

 private:
  void find_halos_below(std::int32_t node, glm::dvec3 point, std::uint32_t own,
                        std::vector<std::uint32_t>& found) const;
};

/// A regular sample of a scan's points, enough for its distribution.
class PointSample {
 public:
  void add(glm::dvec3 point);

  /// Replaces each point by move(point).
  template <class Move>
  void transform(const Move& move) {
    for (glm::dvec3& point : points_) point = move(point);
  }

  [[nodiscard]] const std::vector<glm::dvec3>& points() const { return points_; }
  /// Number of points that each represents.
  [[nodiscard]] std::uint64_t stride() const { return stride_; }

 private:
  std::vector<glm::dvec3> points_;
  std::uint64_t stride_ = 1;
  std::uint64_t seen_ = 0;
};

/// Cuts at medians, across the longest side of the box with the most points, until no tile has more
/// than about `tile_points` of the scan's points. Halos are as wide as a patch's margin, fits and
/// neighbourhoods, at the scan's local spacing or the grid's (0: unknown).
[[nodiscard]] TileLayout lay_tiles(const PointSample& sample, std::uint64_t tile_points,
                                   double grid_spacing);

/// Returns a layout without the cuts whose tiles together have a load of at most `most`: these
/// become one tile. `load`: one value for each tile. Halos are those of lay_tiles for that spacing.
[[nodiscard]] TileLayout coarser_layout(const TileLayout& layout, std::span<const double> load,
                                        double max_load, double grid_spacing);

}  // namespace relief
