#include "preprocess/resample/support/node_support.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

#include "preprocess/resample/support/sectors.h"

namespace relief {
namespace {

// The limit above is on the base plane; on a slope the surface is longer. This is the limit along
// the point's tangent plane. (A tighter limit makes pinholes where normals are noisy.)
constexpr double kSlopeReachInSpacings = 3.0;
// A point counts in surrounding nodes up to this many of its local scan spacings away. A random
// sampling has an empty disc of radius 2.2 spacings about once in four million points (exp(-pi
// 2.2^2)); the rest is for densities that change within the neighbourhood.
constexpr double kSurroundInSpacings = 2.5;
// ... or up to this many grid spacings, for scans finer than the grid: a grid cannot represent
// smaller gaps.
constexpr double kSurroundInGridSpacings = 1.5;
// Search radius for such points, in grid spacings.
constexpr double kWidestSparseInSpacings = 8.0;
// A node is surrounded if no empty sector is wider than this.
constexpr double kWidestSector = 160.0 / 180.0 * std::numbers::pi;

constexpr std::uint8_t kAllOctants = 0xFF;

/// Returns whether a node at (x, y), within kReachInSpacings of a point, is close to it.
bool is_close(const PatchPoints& points, std::uint32_t p, double x, double y, double plane_squared,
              double spacing) {
  const double slope_reach = kSlopeReachInSpacings * spacing;
  const double rise = points.positions[p].z - tangent_height(points, p, x, y);
  return plane_squared + rise * rise <= slope_reach * slope_reach;
}

/// The distance up to which a point counts in surrounding nodes.
double surround_reach(const PatchPoints& points, std::uint32_t p, double spacing) {
  const float local =
      p < points.own ? points.spacing[p] : std::max(points.spacing[p], points.least_of_others);
  return std::max(kSurroundInSpacings * local, kSurroundInGridSpacings * spacing);
}

/// `widest_reach`: at least that of any point of `lookup`.
bool is_surrounded_within(const PatchPoints& points, const PointGrid& lookup, double x, double y,
                          double spacing, double widest_reach) {
  std::vector<double> angles;
  lookup.for_each_within(x, y, widest_reach, [&](std::uint32_t p, double squared) {
    const double reach = surround_reach(points, p, spacing);
    if (squared > reach * reach) return;
    angles.push_back(std::atan2(points.positions[p].y - y, points.positions[p].x - x));
  });
  if (angles.size() < 3) return false;
  return widest_sectors(angles).width <= kWidestSector;
}

/// Returns the bit of a direction's octant; bits are in the order of angles.
std::uint8_t octant_bit(double dx, double dy) {
  const unsigned quadrant = dy < 0.0 ? (dx < 0.0 ? 2U : 3U) : (dx < 0.0 ? 1U : 0U);
  const unsigned steep = std::abs(dy) > std::abs(dx) ? 1U : 0U;
  return static_cast<std::uint8_t>(1U << (2U * quadrant + (steep ^ (quadrant & 1U))));
}

/// Returns the length of the longest run of octants without a bit.
int empty_run(std::uint8_t octants) {
  int run = 0;
  auto empty = static_cast<std::uint8_t>(~octants);
  while (empty != 0 && run < 8) {
    empty &= std::rotl(empty, 1);
    ++run;
  }
  return run;
}

}  // namespace

bool is_surrounded(const PatchPoints& points, const PointGrid& lookup, double x, double y,
                   double spacing) {
  return is_surrounded_within(points, lookup, x, y, spacing, kWidestSparseInSpacings * spacing);
}

bool is_supported(const PatchPoints& points, const PointGrid& lookup, double x, double y,
                  double spacing) {
  bool close = false;
  lookup.for_each_within(x, y, kReachInSpacings * spacing,
                         [&](std::uint32_t p, double plane_squared) {
                           close = close || is_close(points, p, x, y, plane_squared, spacing);
                         });
  return close || is_surrounded(points, lookup, x, y, spacing);
}

bool NodeSupport::have_all_octants(std::size_t begin, std::size_t end) const {
  if (begin >= end || end - begin > sizeof(std::uint64_t)) return false;
  std::uint64_t eight = 0;
  std::memcpy(&eight, octants_.data() + begin, sizeof eight);
  const auto beyond = static_cast<unsigned>(8 * (sizeof eight - (end - begin)));
  return (std::endian::native == std::endian::little ? ~eight << beyond : ~eight >> beyond) == 0;
}

template <class Fn>
void NodeSupport::for_nodes_within(glm::dvec3 point, double radius, const Fn& fn) {
  // Slightly outward because of rounding; nodes beyond the radius are excluded by their distance.
  constexpr double slack = 1e-6;
  const auto first = [&](double low) {
    return static_cast<std::uint32_t>(std::max(0.0, low / grid_.spacing + 1.0 - slack));
  };
  const auto end = [&](double high, std::uint32_t side) {
    return static_cast<std::uint32_t>(
        std::clamp(high / grid_.spacing + 1.0 + slack, 0.0, static_cast<double>(side)));
  };
  const std::uint32_t i0 = first(point.x - radius - grid_.x0);
  const std::uint32_t i1 = end(point.x + radius - grid_.x0, grid_.width);
  const std::uint32_t j1 = end(point.y + radius - grid_.y0, grid_.height);
  for (std::uint32_t j = first(point.y - radius - grid_.y0); j < j1; ++j) {
    if (have_all_octants(std::size_t{j} * grid_.width + i0, std::size_t{j} * grid_.width + i1))
      continue;
    const double dy = point.y - (grid_.y0 + j * grid_.spacing);
    for (std::uint32_t i = i0; i < i1; ++i) {
      std::uint8_t& octants = octants_[std::size_t{j} * grid_.width + i];
      if (octants == kAllOctants) continue;
      const double dx = point.x - (grid_.x0 + i * grid_.spacing);
      if (dx * dx + dy * dy <= radius * radius) fn(octants, i, j, dx, dy);
    }
  }
}

NodeSupport::NodeSupport(const PatchPoints& points, const PointGrid& lookup, const PatchGrid& grid)
    : points_(points),
      lookup_(lookup),
      grid_(grid),
      octants_(grid.size() + sizeof(std::uint64_t), 0) {
  add_points(0);
}

NodeSupport::NodeSupport(const NodeSupport& fewer, const PointGrid& lookup)
    : points_(fewer.points_),
      lookup_(lookup),
      grid_(fewer.grid_),
      octants_(fewer.octants_),
      widest_reach_(fewer.widest_reach_) {
  add_points(static_cast<std::uint32_t>(fewer.lookup_.size()));
}

void NodeSupport::add_points(std::uint32_t first) {
  const double spacing = grid_.spacing;
  for (std::uint32_t p = first; p < lookup_.size(); ++p) {
    for_nodes_within(
        points_.positions[p], kReachInSpacings * spacing,
        [&](std::uint8_t& octants, std::uint32_t i, std::uint32_t j, double dx, double dy) {
          if (is_close(points_, p, grid_.x0 + i * spacing, grid_.y0 + j * spacing,
                       dx * dx + dy * dy, spacing)) {
            octants = kAllOctants;
          }
        });
  }
  for (std::uint32_t p = first; p < lookup_.size(); ++p) {
    const double reach =
        std::min(surround_reach(points_, p, spacing), kWidestSparseInSpacings * spacing);
    widest_reach_ = std::max(widest_reach_, reach);
    for_nodes_within(points_.positions[p], reach,
                     [](std::uint8_t& octants, std::uint32_t /*i*/, std::uint32_t /*j*/, double dx,
                        double dy) { octants |= octant_bit(dx, dy); });
  }
}

bool NodeSupport::is_supported(std::uint32_t i, std::uint32_t j) const {
  // A run of n empty octants lies in an empty sector of n to n + 2 octants: 45 n to 45 (n + 2)
  // degrees.
  const int run = empty_run(octants_[std::size_t{j} * grid_.width + i]);
  static_assert(kWidestSector > 1.01 * 3.0 * std::numbers::pi / 4.0 &&
                1.01 * kWidestSector < std::numbers::pi);
  if (run <= 1) return true;
  if (run >= 4) return false;
  return is_surrounded_within(points_, lookup_, grid_.x0 + i * grid_.spacing,
                              grid_.y0 + j * grid_.spacing, grid_.spacing, widest_reach_);
}

}  // namespace relief
