#include "preprocess/resample/borders/end_at_border.h"

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <glm/geometric.hpp>

#include "preprocess/resample/support/node_support.h"

namespace relief {
namespace {

// Support reaches beyond points by less than a spacing, and a node more where slits are closed.
constexpr std::int64_t kOverhangRings = 2;
// Holes with fewer samples about them, of eight, stay: they are beyond the end of a narrow part.
constexpr int kFewestSamples = 3;
// As far from a point as this, in spacings of the scan or the grid, a hole may become a sample.
constexpr double kFillReach = 1.5;

/// The samples about a node.
struct Around {
  int samples = 0;    ///< of the eight beside it
  int own = 0;        ///< of those, the region's own
  bool hole = false;  ///< one lies within kOverhangRings
};

/// Decides about nodes one by one.
class BorderNodes {
 public:
  BorderNodes(const ScanBorder& border, const PatchPoints& points, const PatchLookups& lookups,
              const PatchGrid& grid, const std::vector<NodeState>& states)
      : border_(border), points_(points), lookups_(lookups), grid_(grid), states_(states) {}

  [[nodiscard]] NodeState judge(std::int64_t i, std::int64_t j) const {
    const NodeState state = at(i, j);
    const Around around = look_around(i, j);
    if (state == NodeState::Hole ? around.samples < kFewestSamples : !around.hole) return state;
    const glm::dvec2 node(grid_.x0 + static_cast<double>(i) * grid_.spacing,
                          grid_.y0 + static_cast<double>(j) * grid_.spacing);
    const std::uint32_t p = lookups_.supporting.nearest(node.x, node.y, 4.0 * grid_.spacing);
    if (p == PointGrid::kNone) return state;
    const double spacing = points_.spacing[p];
    const glm::dvec3 local(node, tangent_height(points_, p, node.x, node.y));
    const auto beyond = border_.beyond(points_.frame.origin + points_.frame.axes * local,
                                       glm::mat3(points_.frame.axes) * points_.normals[p], spacing);
    if (!beyond) return state;
    const double coarser = std::max(spacing, grid_.spacing);
    if (state == NodeState::Hole) {
      const bool fills = *beyond < 0.0 && glm::distance(glm::dvec2(points_.positions[p]), node) <=
                                              kFillReach * coarser;
      if (!fills) return state;
      return around.own > 0 ? NodeState::Own : NodeState::Margin;
    }
    if (*beyond <= 0.0) return state;
    return is_surrounded(points_, lookups_.all, node.x, node.y, grid_.spacing) ? state
                                                                               : NodeState::Hole;
  }

 private:
  [[nodiscard]] NodeState at(std::int64_t i, std::int64_t j) const {
    if (i < 0 || j < 0 || i >= grid_.width || j >= grid_.height) return NodeState::Hole;
    return states_[static_cast<std::size_t>(j) * grid_.width + static_cast<std::size_t>(i)];
  }

  [[nodiscard]] Around look_around(std::int64_t i, std::int64_t j) const {
    Around around;
    for (std::int64_t y = j - kOverhangRings; y <= j + kOverhangRings; ++y) {
      for (std::int64_t x = i - kOverhangRings; x <= i + kOverhangRings; ++x) {
        if (x == i && y == j) continue;
        const NodeState state = at(x, y);
        if (state == NodeState::Hole) {
          around.hole = true;
        } else if (std::abs(x - i) <= 1 && std::abs(y - j) <= 1) {
          ++around.samples;
          around.own += state == NodeState::Own ? 1 : 0;
        }
      }
    }
    return around;
  }

  const ScanBorder& border_;
  const PatchPoints& points_;
  const PatchLookups& lookups_;
  const PatchGrid& grid_;
  const std::vector<NodeState>& states_;
};

}  // namespace

void end_at_border(const ScanBorder& border, const PatchPoints& points, const PatchLookups& lookups,
                   const PatchGrid& grid, std::vector<NodeState>& states) {
  if (border.empty()) return;
  const std::vector<NodeState> before = states;
  const BorderNodes nodes(border, points, lookups, grid, before);
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i)
      states[std::size_t{j} * grid.width + i] = nodes.judge(i, j);
  }
}

}  // namespace relief
