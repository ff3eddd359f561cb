#include "preprocess/resample/support/support.h"

#include <algorithm>
#include <cmath>

#include "common/patch.h"
#include "preprocess/resample/support/node_support.h"

namespace relief {

PatchGrid lay_grid(const PatchPoints& points, double spacing, int overlap_cells) {
  glm::dvec2 low(points.positions.front());
  glm::dvec2 high = low;
  for (std::size_t p = 0; p < points.own; ++p) {
    low = glm::min(low, glm::dvec2(points.positions[p]));
    high = glm::max(high, glm::dvec2(points.positions[p]));
  }
  const double border = overlap_cells + 1.0;
  const double side = std::max(high.x - low.x, high.y - low.y);
  spacing = std::max(spacing, side / (kMaxPatchSide - 2.0 * border - 2.0));
  PatchGrid grid;
  grid.spacing = spacing;
  const auto nodes = [&](double extent) {
    return static_cast<std::uint32_t>(std::ceil(extent / spacing + 2.0 * border)) + 1;
  };
  grid.width = nodes(high.x - low.x);
  grid.height = nodes(high.y - low.y);
  // The rounding up is shared between both sides.
  grid.x0 = (low.x + high.x - (grid.width - 1) * spacing) / 2.0;
  grid.y0 = (low.y + high.y - (grid.height - 1) * spacing) / 2.0;
  return grid;
}

namespace {

/// The surroundings of a hole.
class Surroundings {
 public:
  Surroundings(const PatchGrid& grid, const std::vector<NodeState>& states, std::uint32_t i,
               std::uint32_t j)
      : grid_(grid), states_(states), i_(i), j_(j) {}

  /// Returns whether one of the eight neighbours is a sample.
  [[nodiscard]] bool has_sample() const {
    for (std::uint32_t b = j_ > 0 ? j_ - 1 : 0; b <= j_ + 1; ++b) {
      for (std::uint32_t a = i_ > 0 ? i_ - 1 : 0; a <= i_ + 1; ++a) {
        if (is_sample(a, b)) return true;
      }
    }
    return false;
  }

  /// With samples on opposite sides, it is narrower than any gap that a grid can represent.
  [[nodiscard]] bool in_slit() const {
    return (is_sample(i_ - 1, j_) && is_sample(i_ + 1, j_)) ||
           (is_sample(i_, j_ - 1) && is_sample(i_, j_ + 1));
  }

 private:
  [[nodiscard]] bool is_sample(std::uint32_t a, std::uint32_t b) const {
    return a < grid_.width && b < grid_.height &&  // -1 wraps around to more than either
           states_[std::size_t{b} * grid_.width + a] != NodeState::Hole;
  }

  const PatchGrid& grid_;
  const std::vector<NodeState>& states_;
  std::uint32_t i_;
  std::uint32_t j_;
};

/// Turns holes that `rule` accepts into `state`; rule(i, j, surroundings).
template <class Rule>
void fill_holes(const PatchGrid& grid, std::vector<NodeState>& states, NodeState state,
                Rule&& rule) {
  const std::vector<NodeState> before = states;
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::size_t node = std::size_t{j} * grid.width + i;
      if (before[node] == NodeState::Hole && rule(i, j, Surroundings(grid, before, i, j))) {
        states[node] = state;
      }
    }
  }
}

/// Extends the margin of a grid that is as coarse as its points over the gap to a denser part,
/// which may be wider than the margin: by nodes without a point beside them, and a margin of those.
void bridge_gaps(const PatchLookups& lookups, const NodeSupport& support, const PatchGrid& grid,
                 std::vector<NodeState>& states) {
  const auto is_in_gap = [&](std::uint32_t i, std::uint32_t j) {
    return lookups.all.nearest(grid.x0 + i * grid.spacing, grid.y0 + j * grid.spacing,
                               kReachInSpacings * grid.spacing) == PointGrid::kNone;
  };
  std::vector<NodeState> bridge(states.size(), NodeState::Hole);
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::size_t node = std::size_t{j} * grid.width + i;
      if (states[node] == NodeState::Margin && is_in_gap(i, j)) bridge[node] = NodeState::Margin;
    }
  }
  const auto extend = [&](auto&& rule) {
    fill_holes(grid, bridge, NodeState::Margin, [&](auto i, auto j, const Surroundings& around) {
      return around.has_sample() && rule(i, j) && support.is_supported(i, j);
    });
  };
  for (int ring = 0; ring < kBridgeRings; ++ring) extend(is_in_gap);
  for (int ring = 0; ring < kStepRings; ++ring) extend([](auto /*i*/, auto /*j*/) { return true; });
  for (std::size_t node = 0; node < states.size(); ++node) {
    if (states[node] == NodeState::Hole) states[node] = bridge[node];
  }
}

}  // namespace

std::vector<NodeState> find_support(const PatchPoints& points, const PatchLookups& lookups,
                                    const PatchGrid& grid, int overlap_cells) {
  std::vector<NodeState> states(grid.size(), NodeState::Hole);
  using Node = std::uint32_t;
  const NodeSupport by_own(points, lookups.own, grid);
  fill_holes(grid, states, NodeState::Own, [&](Node i, Node j, const Surroundings& /*around*/) {
    return by_own.is_supported(i, j);
  });
  fill_holes(grid, states, NodeState::Own,
             [](Node, Node, const Surroundings& around) { return around.in_slit(); });
  if (overlap_cells == 0) return states;

  const NodeSupport by_supporting(by_own, lookups.supporting);
  const bool is_at_step = points.least_of_others > 0.0F;
  const int rings = is_at_step ? std::max(overlap_cells, kStepRings) : overlap_cells;
  for (int ring = 0; ring < rings; ++ring) {
    fill_holes(grid, states, NodeState::Margin, [&](Node i, Node j, const Surroundings& around) {
      return around.has_sample() && by_supporting.is_supported(i, j);
    });
  }
  if (is_at_step) bridge_gaps(lookups, by_supporting, grid, states);
  // A steep slit between two margins would remain a visible gap.
  fill_holes(grid, states, NodeState::Margin, [&](Node i, Node j, const Surroundings& around) {
    return around.in_slit() && is_supported(points, lookups.all, grid.x0 + i * grid.spacing,
                                            grid.y0 + j * grid.spacing, grid.spacing);
  });
  return states;
}

}  // namespace relief
