#include "preprocess/raster/raster_tile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "common/octahedral.h"
#include "common/patch_file/continuation.h"

namespace relief {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Differences of heights per cell, x to the east and y to the north: [Horn 1981] where all eight
/// neighbours have data, as hill shading does; otherwise between those of the same row or column.
glm::dvec2 slope_at(const RasterBand& band, const RasterPlan& plan, std::int64_t i,
                    std::int64_t j) {
  const std::int64_t column = i - plan.window.column;
  const std::int64_t row = j - band.first_row;
  const bool inside = column > 0 && row > 0 && column + 1 < band.columns && row + 1 < band.rows;
  const auto at = [&](std::int64_t di, std::int64_t dj) {
    return inside ? band.heights[static_cast<std::size_t>((row + dj) * band.columns + column + di)]
                  : band.at(i + di, j + dj, plan.window.column);
  };
  const std::array<double, 9> n = {at(-1, -1), at(0, -1), at(1, -1), at(-1, 0), at(0, 0),
                                   at(1, 0),   at(-1, 1), at(0, 1),  at(1, 1)};
  const glm::dvec2 horn((n[2] + 2.0 * n[5] + n[8]) - (n[0] + 2.0 * n[3] + n[6]),
                        (n[0] + 2.0 * n[1] + n[2]) - (n[6] + 2.0 * n[7] + n[8]));
  if (std::isfinite(horn.x) && std::isfinite(horn.y)) return horn / 8.0;
  const auto between = [&](double before, double after) {
    if (std::isfinite(before) && std::isfinite(after)) return 0.5 * (after - before);
    if (std::isfinite(after)) return after - n[4];
    return std::isfinite(before) ? n[4] - before : 0.0;
  };
  return {between(n[3], n[5]), between(n[7], n[1])};
}

/// The step of a patch's heights: the plan's, or as many of it as keep 16 bits.
double step_of(const RasterPlan& plan, double low, double high) {
  const double steps = (high - low) / plan.step;
  return plan.step * std::max(1.0, std::ceil(steps / (kMaxHeightRange - 1)));
}

void add_colours(const RasterPlan& plan, const RasterWindow& tile, Patch& patch) {
  const std::uint32_t scale = plan.texels_per_cell;
  auto& map = patch.colours;
  map.scale = scale;
  map.width = scale * (patch.width - 1) + 1;
  map.height = scale * (patch.height - 1) + 1;
  map.texels.resize(std::size_t{map.width} * map.height);
  const GeoGrid& grid = plan.info.grid;
  const double south = grid.y - (tile.row + tile.rows - 1.0) * grid.dy;
  const double west = grid.x + tile.column * grid.dx;
  for (std::uint32_t j = 0; j < map.height; ++j) {
    for (std::uint32_t i = 0; i < map.width; ++i)
      map.texels[std::size_t{j} * map.width + i] =
          plan.drape->at({west + i * grid.dx / scale, south + j * grid.dy / scale});
  }
}

}  // namespace

double RasterBand::at(std::int64_t column, std::int64_t row, std::uint32_t west) const {
  const std::int64_t i = column - west;
  const std::int64_t j = row - first_row;
  if (i < 0 || j < 0 || i >= columns || j >= rows) return kNone;
  return heights[static_cast<std::size_t>(j) * columns + static_cast<std::size_t>(i)];
}

std::optional<Patch> make_raster_patch(const RasterPlan& plan, const RasterBand& band,
                                       const RasterWindow& tile, RasterError& error) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  // Row 0 of a patch is in the south.
  const auto height_at = [&](std::uint32_t i, std::uint32_t j) {
    return band.at(tile.column + i, tile.row + tile.rows - 1 - j, plan.window.column);
  };
  for (std::uint32_t j = 0; j < tile.rows; ++j) {
    for (std::uint32_t i = 0; i < tile.columns; ++i) {
      const double h = height_at(i, j);
      if (!std::isfinite(h)) continue;
      low = std::min(low, h);
      high = std::max(high, h);
    }
  }
  if (!(low <= high)) return std::nullopt;

  Patch patch;
  const double step = step_of(plan, low, high);
  const double base = std::floor((low - plan.offset) / step) * step + plan.offset;
  error.is_coarser = step > plan.step;
  const GeoGrid& grid = plan.info.grid;
  const glm::dvec2 corner = plan.frame.world(
      {grid.x + tile.column * grid.dx, grid.y - (tile.row + tile.rows - 1.0) * grid.dy});
  patch.origin = {corner, base * plan.height_unit};
  patch.spacing = plan.spacing;
  patch.height_step = step * plan.height_unit;
  patch.width = tile.columns;
  patch.height = tile.rows;
  patch.heights.assign(std::size_t{patch.width} * patch.height, kHole);
  patch.normals.width = patch.width;
  patch.normals.height = patch.height;
  patch.normals.texels.assign(patch.heights.size(), glm::i16vec2(0));
  std::vector<std::uint8_t> kept(patch.heights.size(), 0);
  const double per_cell = plan.height_unit / plan.spacing;
  std::size_t k = 0;
  for (std::uint32_t j = 0; j < patch.height; ++j) {
    for (std::uint32_t i = 0; i < patch.width; ++i, ++k) {
      const double h = height_at(i, j);
      if (!std::isfinite(h)) continue;
      patch.heights[k] = static_cast<std::int32_t>(std::lround((h - base) / step));
      const double off = std::abs(base + patch.heights[k] * step - h) * plan.height_unit;
      error.sum_of_squares += off * off;
      error.largest = std::max(error.largest, off);
      ++error.cells;
      const glm::dvec2 slope =
          per_cell * slope_at(band, plan, tile.column + i, tile.row + tile.rows - 1 - j);
      patch.normals.texels[k] =
          snorm16_from_unit(glm::vec3(glm::normalize(glm::dvec3(-slope, 1.0))));
      kept[k] = 1;
    }
  }
  continue_over_holes(patch.normals, kept);
  if (plan.drape != nullptr) add_colours(plan, tile, patch);
  return patch;
}

}  // namespace relief
