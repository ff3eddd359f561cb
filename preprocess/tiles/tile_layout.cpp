#include "preprocess/tiles/tile_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "common/neighbours/neighbours.h"

namespace relief {
namespace {

// 35 MB with the search for neighbours; a tile of 130,000 points of 60 million has 500 of them,
// which locate its median to a thirtieth.
constexpr std::size_t kMaxSampled = std::size_t{1} << 18U;

// Outliers must not decide the shape of a scan: a side's length is that without these shares at its
// ends.
constexpr double kTail = 0.02;

// A margin of a cell and the 2.5 spacings that its fits reach, then the points' neighbourhoods (16
// neighbours reach 2.3 spacings; their spacing depends on neighbours of neighbours), doubled,
// because sparse parts are sparser than nine tenths of their tile.
constexpr double kHaloInSpacings = 12.0;
constexpr double kDenserThan = 0.9;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

class Layouter {
 public:
  Layouter(const PointSample& sample, std::uint64_t tile_points, double grid_spacing)
      : points_(sample.points()),
        // Squares of local spacings grow by the factor by which a sample thins the points.
        spacing_factor_(1.0 / std::sqrt(static_cast<double>(sample.stride()))),
        max_sampled_(std::max<std::uint64_t>(tile_points / sample.stride(), 16)),
        grid_spacing_(grid_spacing),
        graph_(find_neighbours(points_, kSurfaceNeighbours)),
        order_(points_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
  }

  TileLayout run() {
    lay(order_, {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)});
    return std::move(layout_);
  }

 private:
  // Returns the node's number as in Cut.
  std::int32_t lay(std::span<std::uint32_t> points, const Bounds& region) {
    const std::optional<TileLayout::Cut> cut =
        points.size() > max_sampled_ ? find_cut(points) : std::nullopt;
    if (!cut) return add_tile(points, region);
    const auto number = static_cast<std::int32_t>(layout_.cuts.size());
    layout_.cuts.push_back(*cut);
    const auto middle = std::partition(points.begin(), points.end(), [&](std::uint32_t i) {
      return points_[i][cut->axis] < cut->at;
    });
    const auto left = static_cast<std::size_t>(middle - points.begin());
    Bounds below = region;
    Bounds above = region;
    below.max[cut->axis] = above.min[cut->axis] = cut->at;
    const std::int32_t left_node = lay(points.first(left), below);
    const std::int32_t right_node = lay(points.subspan(left), above);
    TileLayout::Cut& stored = layout_.cuts[static_cast<std::size_t>(number)];
    stored.left = left_node;
    stored.right = right_node;
    return number;
  }

  // Cuts at the median of the longest side that has points on both sides; nothing if all points
  // coincide.
  std::optional<TileLayout::Cut> find_cut(std::span<const std::uint32_t> points) {
    std::vector<double> along(points.size());
    std::optional<TileLayout::Cut> best;
    double longest = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      std::transform(points.begin(), points.end(), along.begin(),
                     [&](std::uint32_t i) { return points_[i][axis]; });
      std::sort(along.begin(), along.end());
      const auto at_share = [&](double share) {
        return along[static_cast<std::size_t>(share * static_cast<double>(along.size() - 1))];
      };
      const double length = at_share(1.0 - kTail) - at_share(kTail);
      const double median = at_share(0.5);
      if (!(along.front() < median) || length <= longest) continue;
      longest = length;
      best = TileLayout::Cut{axis, 0, 0, median};
    }
    return best;
  }

  std::int32_t add_tile(std::span<const std::uint32_t> points, const Bounds& region) {
    std::vector<double> spacing;
    for (const std::uint32_t i : points) {
      if (i < graph_.spacing.size()) spacing.push_back(graph_.spacing[i] * spacing_factor_);
    }
    double wide = grid_spacing_;
    if (!spacing.empty()) {
      const auto at = spacing.begin() + static_cast<std::ptrdiff_t>(
                                            kDenserThan * static_cast<double>(spacing.size() - 1));
      std::nth_element(spacing.begin(), at, spacing.end());
      wide = std::max(wide, *at);
    }
    layout_.tiles.push_back({region, kHaloInSpacings * wide});
    layout_.largest_halo = std::max(layout_.largest_halo, kHaloInSpacings * wide);
    return ~static_cast<std::int32_t>(layout_.tiles.size() - 1);
  }

  const std::vector<glm::dvec3>& points_;
  double spacing_factor_;
  std::uint64_t max_sampled_;
  double grid_spacing_;
  NeighbourGraph graph_;
  std::vector<std::uint32_t> order_;
  TileLayout layout_;
};

/// Copies the cuts of a layout that are still needed.
class Coarsener {
 public:
  Coarsener(const TileLayout& from, std::span<const double> load, double max_load,
            double grid_spacing)
      : from_(from), load_(load), max_load_(max_load), grid_spacing_(grid_spacing) {}

  TileLayout run() {
    lay(from_.cuts.empty() ? ~0 : 0, {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)});
    layout_.largest_halo = kHaloInSpacings * grid_spacing_;
    return std::move(layout_);
  }

 private:
  static std::size_t tile_number(std::int32_t node) {
    const std::int32_t tile = ~node;
    return static_cast<std::size_t>(tile);
  }

  [[nodiscard]] double load_below(std::int32_t node) const {
    if (node < 0) return load_[tile_number(node)];
    const TileLayout::Cut& cut = from_.cuts[static_cast<std::size_t>(node)];
    return load_below(cut.left) + load_below(cut.right);
  }

  std::int32_t lay(std::int32_t node, const Bounds& region) {
    if (node < 0 || load_below(node) <= max_load_) {
      layout_.tiles.push_back({region, kHaloInSpacings * grid_spacing_});
      return ~static_cast<std::int32_t>(layout_.tiles.size() - 1);
    }
    const TileLayout::Cut cut = from_.cuts[static_cast<std::size_t>(node)];
    const std::size_t number = layout_.cuts.size();
    layout_.cuts.push_back(cut);
    Bounds below = region;
    Bounds above = region;
    below.max[cut.axis] = above.min[cut.axis] = cut.at;
    const std::int32_t left = lay(cut.left, below);
    const std::int32_t right = lay(cut.right, above);
    layout_.cuts[number].left = left;
    layout_.cuts[number].right = right;
    return static_cast<std::int32_t>(number);
  }

  const TileLayout& from_;
  std::span<const double> load_;
  double max_load_;
  double grid_spacing_;
  TileLayout layout_;
};

bool is_in_halo(const Tile& tile, glm::dvec3 p) {
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] < tile.region.min[axis] - tile.halo || p[axis] > tile.region.max[axis] + tile.halo)
      return false;
  }
  return true;
}

}  // namespace

std::uint32_t TileLayout::tile_of(glm::dvec3 point) const {
  std::int32_t node = cuts.empty() ? ~0 : 0;
  while (node >= 0) {
    const Cut& cut = cuts[static_cast<std::size_t>(node)];
    node = point[cut.axis] < cut.at ? cut.left : cut.right;
  }
  return static_cast<std::uint32_t>(~node);
}

std::uint32_t TileLayout::tile_about(const Tile& finer) const {
  glm::dvec3 inside(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isfinite(finer.region.min[axis])) {
      inside[axis] = finer.region.min[axis];
    } else if (std::isfinite(finer.region.max[axis])) {
      inside[axis] = std::nextafter(finer.region.max[axis], -kInfinity);
    }
  }
  return tile_of(inside);
}

void TileLayout::find_halos(glm::dvec3 point, std::uint32_t own,
                            std::vector<std::uint32_t>& found) const {
  found.clear();
  if (!cuts.empty()) find_halos_below(0, point, own, found);
}

void TileLayout::find_halos_below(std::int32_t node, glm::dvec3 point, std::uint32_t own,
                                  std::vector<std::uint32_t>& found) const {
  if (node < 0) {
    const auto tile = static_cast<std::uint32_t>(~node);
    if (tile != own && is_in_halo(tiles[tile], point)) found.push_back(tile);
    return;
  }
  const Cut& cut = cuts[static_cast<std::size_t>(node)];
  if (point[cut.axis] <= cut.at + largest_halo) find_halos_below(cut.left, point, own, found);
  if (point[cut.axis] >= cut.at - largest_halo) find_halos_below(cut.right, point, own, found);
}

void PointSample::add(glm::dvec3 point) {
  if (seen_++ % stride_ != 0) return;
  points_.push_back(point);
  if (points_.size() < kMaxSampled) return;
  for (std::size_t i = 0; 2 * i < points_.size(); ++i) points_[i] = points_[2 * i];
  points_.resize((points_.size() + 1) / 2);
  stride_ *= 2;
}

TileLayout lay_tiles(const PointSample& sample, std::uint64_t tile_points, double grid_spacing) {
  return Layouter(sample, tile_points, grid_spacing).run();
}

TileLayout coarser_layout(const TileLayout& layout, std::span<const double> load, double max_load,
                          double grid_spacing) {
  return Coarsener(layout, load, max_load, grid_spacing).run();
}

}  // namespace relief
