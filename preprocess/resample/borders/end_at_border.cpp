#include "preprocess/resample/borders/end_at_border.h"

#include <algorithm>
#include <cstddef>

#include "preprocess/resample/node_support.h"

namespace relief {
namespace {

// Support reaches beyond points by less than a spacing, and a node more where slits are closed.
constexpr std::int64_t kOverhangRings = 2;
// Holes with fewer samples about them, of eight, stay: they are beyond the end of a narrow part.
constexpr int kFewestSamples = 3;
// As far from a point as this, in spacings of the scan or the grid, a hole may become a sample.
constexpr double kFillReach = 1.5;

class BorderNodes {
 public:
  BorderNodes(const ScanBorder& border, const PatchPoints& points, const PatchLookups& lookups,
              const PatchGrid& grid, const std::vector<NodeState>& states)
      : border_(border), points_(points), lookups_(lookups), grid_(grid), states_(states) {}

  NodeState judge(std::int64_t i, std::int64_t j) const {
    const NodeState state = at(i, j);
    int own = 0;
    int samples = 0;
    bool has_hole = false;
    for (std::int64_t y = j - kOverhangRings; y <= j + kOverhangRings; ++y) {
      for (std::int64_t x = i - kOverhangRings; x <= i + kOverhangRings; ++x) {
        const NodeState other = at(x, y);
        has_hole = has_hole || other == NodeState::Hole;
        if (other == NodeState::Hole || std::max(std::abs(x - i), std::abs(y - j)) > 1) continue;
        ++samples;
        own += other == NodeState::Own ? 1 : 0;
      }
    }
    if (state == NodeState::Hole ? samples < kFewestSamples : !has_hole) return state;
    const double x = grid_.x0 + static_cast<double>(i) * grid_.spacing;
    const double y = grid_.y0 + static_cast<double>(j) * grid_.spacing;
    const std::uint32_t p = lookups_.supporting.nearest(x, y, 4.0 * grid_.spacing);
    if (p == PointGrid::kNone) return state;
    const double spacing = points_.spacing[p];
    const glm::dvec3 world =
        points_.frame.origin +
        points_.frame.axes * glm::dvec3(x, y, tangent_height(points_, p, x, y));
    const glm::vec3 normal = glm::mat3(points_.frame.axes) * points_.normals[p];
    const auto beyond = border_.beyond(world, normal, spacing);
    if (!beyond) return state;
    if (state == NodeState::Hole) {
      const double reach = kFillReach * std::max(spacing, grid_.spacing);
      const glm::dvec2 d = glm::dvec2(points_.positions[p]) - glm::dvec2(x, y);
      const bool fills = *beyond < 0.0 && d.x * d.x + d.y * d.y <= reach * reach;
      if (!fills) return state;
      return own > 0 ? NodeState::Own : NodeState::Margin;
    }
    const bool drops = *beyond > 0.0 && !is_surrounded(points_, lookups_.all, x, y, grid_.spacing);
    return drops ? NodeState::Hole : state;
  }

 private:
  [[nodiscard]] NodeState at(std::int64_t i, std::int64_t j) const {
    if (i < 0 || j < 0 || i >= grid_.width || j >= grid_.height) return NodeState::Hole;
    return states_[static_cast<std::size_t>(j) * grid_.width + static_cast<std::size_t>(i)];
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
