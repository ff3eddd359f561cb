#include "preprocess/resample/joined_borders.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <numeric>

#include "common/seams/border_mesh.h"
#include "common/seams/cell_triangles.h"
#include "common/seams/vertex_grid.h"

namespace relief {
namespace {

// Points within this many grid spacings, or scan spacings if those are larger, are looked at.
constexpr double kSearchInSpacings = 2.0;
// Each has a vote of exp(-d^2 / s^2), s in the same spacings ...
constexpr double kVoteInSpacings = 0.7;
// ... and a node stays with this share of the votes for its own region. It is below a half so that
// where three regions meet none of a node's copies is lost; thin_borders() sees to the doubles.
constexpr double kOwnShare = 0.35;
// A node with no point in a sector wider than this, in radians, lies beyond the border of the
// scan's sheet ...
constexpr double kOpenSector = 190.0 / 180.0 * std::numbers::pi;
// ... and stays only if it is within this many grid spacings of a point.
constexpr double kOverhangInSpacings = 0.6;
// Nodes farther than this many rings from a hole are not looked at: regions end where support does.
constexpr std::int64_t kBorderRings = 3;
// Samples of two patches nearer than this, in spacings, make slivers.
constexpr double kNearInSpacings = 0.45;

/// The widest angle between neighbouring directions; sorts them.
double widest_sector(std::vector<double>& angles) {
  if (angles.empty()) return 2.0 * std::numbers::pi;
  std::sort(angles.begin(), angles.end());
  double widest = angles.front() + 2.0 * std::numbers::pi - angles.back();
  for (std::size_t k = 1; k < angles.size(); ++k)
    widest = std::max(widest, angles[k] - angles[k - 1]);
  return widest;
}

/// Nodes of the region's own, 1 if some node within kBorderRings is none or the grid ends there.
std::vector<std::uint8_t> near_border(const std::vector<NodeState>& states, const PatchGrid& grid) {
  const auto width = static_cast<std::int64_t>(grid.width);
  const auto height = static_cast<std::int64_t>(grid.height);
  // First along rows, then along columns.
  std::vector<std::uint8_t> in_row(states.size(), 0);
  std::vector<std::uint8_t> near(states.size(), 0);
  for (std::int64_t j = 0; j < height; ++j) {
    for (std::int64_t i = 0; i < width; ++i) {
      for (std::int64_t x = i - kBorderRings; x <= i + kBorderRings; ++x) {
        if (x < 0 || x >= width ||
            states[static_cast<std::size_t>(j * width + x)] != NodeState::Own)
          in_row[static_cast<std::size_t>(j * width + i)] = 1;
      }
    }
  }
  for (std::int64_t j = 0; j < height; ++j) {
    for (std::int64_t i = 0; i < width; ++i) {
      for (std::int64_t y = j - kBorderRings; y <= j + kBorderRings; ++y) {
        if (y < 0 || y >= height || in_row[static_cast<std::size_t>(y * width + i)] != 0)
          near[static_cast<std::size_t>(j * width + i)] = 1;
      }
    }
  }
  return near;
}

}  // namespace

void drop_foreign_nodes(const PatchPoints& points, std::uint32_t of_others, const PointGrid& all,
                        const std::vector<SurfacePoint>& surface, const PatchGrid& grid,
                        std::vector<NodeState>& states) {
  double widest = grid.spacing;
  for (std::size_t p = 0; p < points.own; ++p) widest = std::max(widest, double{points.spacing[p]});
  const std::vector<std::uint8_t> is_near_border = near_border(states, grid);
  const bool keeps_margins =
      std::ranges::any_of(points.ids, [of_others](std::uint32_t id) { return id >= of_others; });
  std::vector<double> angles;
  for (std::size_t m = 0; m < states.size(); ++m) {
    const bool is_margin = states[m] == NodeState::Margin;
    if (is_margin && !keeps_margins) states[m] = NodeState::Hole;
    if (states[m] == NodeState::Hole || (!is_margin && is_near_border[m] == 0)) continue;
    const std::size_t i = m % grid.width;
    const std::size_t j = m / grid.width;
    const glm::dvec3 node(grid.x0 + static_cast<double>(i) * grid.spacing,
                          grid.y0 + static_cast<double>(j) * grid.spacing, surface[m].height);
    double nearest = std::numeric_limits<double>::max();
    double for_own = 0.0;
    double for_others = 0.0;
    double for_tiles = 0.0;  // other ones
    angles.clear();
    all.for_each_within(node.x, node.y, kSearchInSpacings * widest,
                        [&](std::uint32_t p, double plane_squared) {
                          if (glm::dot(points.normals[p], surface[m].fitted_normal) <= 0.0F) return;
                          const glm::dvec3 d = points.positions[p] - node;
                          const double squared = plane_squared + d.z * d.z;
                          const double spacing = std::max(grid.spacing, double{points.spacing[p]});
                          const double relative = squared / (spacing * spacing);
                          if (relative <= kSearchInSpacings * kSearchInSpacings)
                            angles.push_back(std::atan2(d.y, d.x));
                          nearest = std::min(nearest, squared);
                          (p < points.own               ? for_own
                           : points.ids[p] >= of_others ? for_tiles
                                                        : for_others) +=
                              std::exp(-relative / (kVoteInSpacings * kVoteInSpacings));
                        });
    if (is_margin) {
      if (for_tiles <= for_others) states[m] = NodeState::Hole;
      continue;
    }
    for_own += for_tiles;
    const double overhang = kOverhangInSpacings * grid.spacing;
    const bool overhangs = nearest > overhang * overhang && widest_sector(angles) > kOpenSector;
    if (for_own < kOwnShare * (for_own + for_others) || overhangs) states[m] = NodeState::Hole;
  }
}

void thin_borders(std::span<Patch> patches) {
  const BorderMesh borders = find_borders(patches, cell_triangles(std::span<const Patch>(patches)));
  const std::vector<BorderVertex>& vertices = borders.vertices;
  const VertexGrid lookup(vertices);
  const auto faces = [&](std::uint32_t v) {
    return glm::dot(patches[vertices[v].patch].axes[2], vertices[v].normal);
  };
  std::vector<std::uint32_t> askew_last(vertices.size());
  std::iota(askew_last.begin(), askew_last.end(), 0U);
  std::stable_sort(askew_last.begin(), askew_last.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return faces(a) > faces(b); });
  std::vector<std::uint8_t> kept(vertices.size(), 0);
  for (const std::uint32_t v : askew_last) {
    const BorderVertex& vertex = vertices[v];
    kept[v] = 1;
    lookup.for_each_within(vertex.position, kNearInSpacings * vertex.spacing, [&](std::uint32_t w) {
      const BorderVertex& other = vertices[w];
      if (other.patch == vertex.patch || kept[w] == 0) return;
      if (glm::dot(other.normal, vertex.normal) > 0.0) kept[v] = 0;
    });
    if (kept[v] == 0) patches[vertex.patch].heights[vertex.node] = kHole;
  }
}

}  // namespace relief
