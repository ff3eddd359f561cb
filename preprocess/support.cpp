#include "preprocess/support.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/patch.h"

namespace relief {
namespace {

// Within this many grid spacings of a point a node is taken without further question: a border
// moves outward by less than one spacing.
constexpr double kReachInSpacings = 0.9;
// That is on the base plane; on a slope the surface is longer. Along the point's tangent plane the
// node may be this many spacings away. (A tighter limit makes pinholes where normals are noisy.)
constexpr double kSlopeReachInSpacings = 3.0;
// A point takes part in surrounding nodes up to this many of its own local scan spacings away. A
// random sampling has an empty disc of radius 2.2 spacings about once in four million points
// (exp(-pi 2.2^2)); the rest is for densities that change within the neighbourhood.
constexpr double kSurroundInSpacings = 2.5;
// ... or up to this many grid spacings, where the scan is finer than the grid: less is no gap that
// a grid can keep.
constexpr double kSurroundInGridSpacings = 1.5;
// Such points are looked for within this many grid spacings.
constexpr double kWidestSparseInSpacings = 8.0;
// Surrounded: no empty sector wider than this.
constexpr double kWidestSector = 160.0 / 180.0 * std::numbers::pi;

bool surrounded(const PatchPoints& points, const PointGrid& lookup, double x, double y,
                double spacing) {
  std::vector<double> angles;
  lookup.for_each_within(
      x, y, kWidestSparseInSpacings * spacing, [&](std::uint32_t p, double squared) {
        const double reach =
            std::max(kSurroundInSpacings * points.spacing[p], kSurroundInGridSpacings * spacing);
        if (squared > reach * reach) return;
        angles.push_back(std::atan2(points.positions[p].y - y, points.positions[p].x - x));
      });
  if (angles.size() < 3) return false;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2.0 * std::numbers::pi - angles.back();
  for (std::size_t m = 1; m < angles.size(); ++m) {
    widest = std::max(widest, angles[m] - angles[m - 1]);
  }
  return widest <= kWidestSector;
}

}  // namespace

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

bool is_supported(const PatchPoints& points, const PointGrid& lookup, double x, double y,
                  double spacing) {
  const double reach = kReachInSpacings * spacing;
  const double slope_reach = kSlopeReachInSpacings * spacing;
  bool close = false;
  lookup.for_each_within(x, y, reach, [&](std::uint32_t p, double plane_squared) {
    const double rise = points.positions[p].z - tangent_height(points, p, x, y);
    close |= plane_squared + rise * rise <= slope_reach * slope_reach;
  });
  return close || surrounded(points, lookup, x, y, spacing);
}

namespace {

// Visits the up to eight neighbours of a node.
template <class Fn>
void for_neighbours(const PatchGrid& grid, std::uint32_t i, std::uint32_t j, Fn&& fn) {
  for (std::uint32_t b = j > 0 ? j - 1 : 0; b <= std::min(j + 1, grid.height - 1); ++b) {
    for (std::uint32_t a = i > 0 ? i - 1 : 0; a <= std::min(i + 1, grid.width - 1); ++a) {
      if (a != i || b != j) fn(std::size_t{b} * grid.width + a);
    }
  }
}

// What surrounds a hole.
struct Surroundings {
  int samples = 0;  // of its eight neighbours
  // With samples on opposite sides it is narrower than a grid can tell from a gap.
  bool in_slit = false;
};

// Turns holes that `rule` accepts into `state`; rule(i, j, surroundings).
template <class Rule>
void fill_holes(const PatchGrid& grid, std::vector<NodeState>& states, NodeState state,
                Rule&& rule) {
  const std::vector<NodeState> before = states;
  for (std::uint32_t j = 0; j < grid.height; ++j) {
    for (std::uint32_t i = 0; i < grid.width; ++i) {
      const std::size_t node = std::size_t{j} * grid.width + i;
      if (before[node] != NodeState::Hole) continue;
      const auto sample = [&](std::uint32_t a, std::uint32_t b) {
        return a < grid.width && b < grid.height &&  // -1 wraps around to more than either
               before[std::size_t{b} * grid.width + a] != NodeState::Hole;
      };
      Surroundings around;
      for_neighbours(grid, i, j, [&](std::size_t m) {
        if (before[m] != NodeState::Hole) ++around.samples;
      });
      around.in_slit =
          (sample(i - 1, j) && sample(i + 1, j)) || (sample(i, j - 1) && sample(i, j + 1));
      if (rule(i, j, around)) states[node] = state;
    }
  }
}

}  // namespace

std::vector<NodeState> find_support(const PatchPoints& points, const PatchLookups& lookups,
                                    const PatchGrid& grid, int overlap_cells) {
  std::vector<NodeState> states(grid.size(), NodeState::Hole);
  const auto supported = [&](const PointGrid& lookup, std::uint32_t i, std::uint32_t j) {
    return is_supported(points, lookup, grid.x0 + i * grid.spacing, grid.y0 + j * grid.spacing,
                        grid.spacing);
  };
  using Node = std::uint32_t;
  fill_holes(grid, states, NodeState::Own, [&](Node i, Node j, const Surroundings& /*around*/) {
    return supported(lookups.own, i, j);
  });
  fill_holes(grid, states, NodeState::Own,
             [](Node, Node, const Surroundings& around) { return around.in_slit; });
  for (int ring = 0; ring < overlap_cells; ++ring) {
    fill_holes(grid, states, NodeState::Margin, [&](Node i, Node j, const Surroundings& around) {
      return around.samples > 0 && supported(lookups.supporting, i, j);
    });
  }
  if (overlap_cells > 0) {
    // What is too steep between two margins is still seen through.
    fill_holes(grid, states, NodeState::Margin, [&](Node i, Node j, const Surroundings& around) {
      return around.in_slit && supported(lookups.all, i, j);
    });
  }
  return states;
}

}  // namespace relief
