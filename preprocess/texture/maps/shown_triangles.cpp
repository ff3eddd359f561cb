#include "preprocess/texture/maps/shown_triangles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "common/patch_file/continuation.h"
#include "preprocess/texture/maps/map_scales.h"

namespace relief {
namespace {

/// Handicap of triangles that face away, cells: the back of a thin sheet has its own texels.
constexpr double kFacingAway = 3.0;
/// Weights this far below 0 still count, so that no texel falls between two triangles.
constexpr double kOnEdge = -1e-9;
/// Weights below this are surely below kOnEdge, whatever the rounding.
constexpr double kSurelyOutside = 2.0 * kOnEdge;

/// The patch's surface, cells, continued over holes.
class Surface {
 public:
  explicit Surface(const Patch& patch) : in_cells_(patch.height_step / patch.spacing) {
    heights_.width = patch.width;
    heights_.height = patch.height;
    std::vector<std::uint8_t> kept;
    for (const std::int32_t h : patch.heights) {
      kept.push_back(h != kHole ? 1 : 0);
      heights_.texels.emplace_back(h != kHole ? h : 0);
    }
    continue_over_holes(heights_, kept);
  }

  /// Its heights at the positions of a map's rows and columns, row by row.
  [[nodiscard]] std::vector<double> at(const std::vector<double>& rows,
                                       const std::vector<double>& columns) const {
    std::vector<double> heights;
    heights.reserve(rows.size() * columns.size());
    for (const double row : rows) {
      for (const double column : columns) heights.push_back(at({column, row}));
    }
    return heights;
  }

 private:
  [[nodiscard]] double at(glm::dvec2 position) const {
    const auto i = static_cast<std::uint32_t>(position.x);
    const auto j = static_cast<std::uint32_t>(position.y);
    const double x = position.x - i;
    const double y = position.y - j;
    return in_cells_ * ((1.0 - y) * ((1.0 - x) * node(i, j) + x * node(i + 1, j)) +
                        y * ((1.0 - x) * node(i, j + 1) + x * node(i + 1, j + 1)));
  }

  [[nodiscard]] double node(std::uint32_t i, std::uint32_t j) const {
    const std::size_t row = std::size_t{std::min(j, heights_.height - 1)} * heights_.width;
    return heights_.texels[row + std::min(i, heights_.width - 1)].x;
  }

  AttributeMap<glm::vec<1, std::int32_t>> heights_;
  double in_cells_;
};

/// Where the texels of a map's row or column are, cells.
std::vector<double> texels_along(std::uint32_t side, double scale) {
  std::vector<double> positions(side);
  for (std::uint32_t k = 0; k < side; ++k) positions[k] = k / scale;
  return positions;
}

}  // namespace

std::vector<std::uint32_t> find_shown(const Patch& patch, std::uint32_t texels_per_cell,
                                      const std::vector<FlatTriangle>& triangles) {
  const auto width = static_cast<std::uint32_t>(map_side(patch.width, texels_per_cell));
  const auto height = static_cast<std::uint32_t>(map_side(patch.height, texels_per_cell));
  std::vector<std::uint32_t> shown(std::size_t{width} * height, kNoTriangle);
  std::vector<float> lowest_cost(shown.size(), std::numeric_limits<float>::infinity());
  const double scale = texels_per_cell;
  const std::vector<double> columns = texels_along(width, scale);
  const std::vector<double> rows = texels_along(height, scale);
  const std::vector<double> surface = Surface(patch).at(rows, columns);
  // Whole texels of the map, often none.
  const auto first = [scale](double low, std::uint32_t side) {
    const double at = low * scale - 1e-6;
    if (!(at > 0.0)) return std::uint32_t{0};
    if (at >= side) return side;
    const auto below = static_cast<std::uint32_t>(at);
    return below < at ? below + 1 : below;
  };
  const auto end = [scale](double high, std::uint32_t side) {
    const double at = high * scale + 1e-6;
    if (!(at >= 0.0)) return std::uint32_t{0};
    return at < side ? static_cast<std::uint32_t>(at) + 1 : side;
  };
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const FlatTriangle& triangle = triangles[t];
    const auto& p = triangle.corners;
    const auto [left, right] = std::minmax({p[0].x, p[1].x, p[2].x});
    const auto [low, high] = std::minmax({p[0].y, p[1].y, p[2].y});
    const double penalty = triangle.twice_area > 0.0 ? 0.0 : kFacingAway;
    // Most texels of a triangle's box are beside it: they are done with before the division.
    const double side = triangle.twice_area > 0.0 ? 1.0 : -1.0;
    const double outside = kSurelyOutside * std::abs(triangle.twice_area);
    const std::uint32_t a0 = first(left, width);
    const std::uint32_t a1 = end(right, width);
    const std::uint32_t b1 = end(high, height);
    for (std::uint32_t b = first(low, height); b < b1; ++b) {
      for (std::uint32_t a = a0; a < a1; ++a) {
        const glm::dvec3 areas = triangle.areas_at({columns[a], rows[b]});
        const glm::dvec3 inward = side * areas;
        if (inward.x < outside || inward.y < outside || inward.z < outside) continue;
        const glm::dvec3 weights = areas / triangle.twice_area;
        if (std::min({weights.x, weights.y, weights.z}) < kOnEdge) continue;
        const std::size_t k = std::size_t{b} * width + a;
        const double away = std::abs(glm::dot(weights, triangle.heights) - surface[k]);
        const auto cost = static_cast<float>(away + penalty);
        if (away > kTexelReach || !(cost < lowest_cost[k])) continue;
        lowest_cost[k] = cost;
        shown[k] = t;
      }
    }
  }
  return shown;
}

TexcoordsOverPatch::TexcoordsOverPatch(const FlatTriangle& triangle, const CornerTexcoords& corners,
                                       double scale)
    : triangle_(&triangle), corners_(corners) {
  const glm::dvec2 here = at({0.0, 0.0});
  du_ = glm::vec2(at({1.0 / scale, 0.0}) - here);
  dv_ = glm::vec2(at({0.0, 1.0 / scale}) - here);
}

glm::dvec2 TexcoordsOverPatch::at(glm::dvec2 position) const {
  const glm::dvec3 w = triangle_->weights_at(position);
  return w.x * glm::dvec2(corners_[0]) + w.y * glm::dvec2(corners_[1]) +
         w.z * glm::dvec2(corners_[2]);
}

}  // namespace relief
