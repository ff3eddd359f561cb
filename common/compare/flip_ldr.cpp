#include "common/compare/flip_ldr.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/compare/flip_colour.h"
#include "common/compare/tone_mapping.h"

namespace relief {
namespace {

/// XYZ filtered for the resolution of the eye, as luminance Y and opponent colours X - Y and Y - Z:
/// the papers' YCxCz without its factors and offset, which linear filters pass on.
struct Contrast {
  std::vector<float> luminance, red_green, blue_yellow, blue_yellow_wide;
};

/// Rows of one image about a tile, filtered along x.
struct FilteredRows {
  Contrast contrast;
  std::vector<float> smooth, edge, point;
};

/// One row, filtered along both axes.
struct Row {
  Contrast contrast;
  std::vector<float> edge_x, edge_y, point_x, point_y;
};

/// A part of a row as luminance and opponent colours, with `padding` more pixels at both ends for
/// the filters.
class PaddedRow {
 public:
  PaddedRow(std::uint32_t width, std::size_t padding) : padding_(padding) {
    for (auto& channel : channels_) channel.resize(width + 2 * padding);
  }

  /// Loads row `y` from `padding` pixels before `x`. Beyond the rim its outermost pixels repeat.
  void load(const LinearColour& image, std::uint32_t x, std::uint32_t y,
            std::optional<double> gain) {
    // Of channels_, the value at i is that of pixel x + i - padding.
    const std::size_t size = channels_[0].size();
    const std::size_t begin = padding_ - std::min<std::size_t>(padding_, x);
    const std::size_t end = std::min(size, image.width - x + padding_);
    const std::size_t row = std::size_t{y} * image.width + x;
    const auto shown = [&](std::size_t channel, std::size_t k) {
      const float light = image.rgb[channel][k];
      return gain ? tone_map(light, *gain) : std::min(light, 1.0F);
    };
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t k = row + i - padding_;
      const glm::vec3 xyz = xyz_from_rgb({shown(0, k), shown(1, k), shown(2, k)});
      channels_[0][i] = xyz.y;
      channels_[1][i] = xyz.x - xyz.y;
      channels_[2][i] = xyz.y - xyz.z;
    }
    for (auto& channel : channels_) {
      std::fill(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(begin),
                channel[begin]);
      std::fill(channel.begin() + static_cast<std::ptrdiff_t>(end), channel.end(),
                channel[end - 1]);
    }
  }

  /// Returns the first value that a filter of `radius` reads.
  [[nodiscard]] const float* start(std::size_t channel, std::size_t radius) const {
    return channels_[channel].data() + (padding_ - radius);
  }

 private:
  std::size_t padding_;
  std::array<std::vector<float>, 3> channels_;  ///< Y, X - Y, Y - Z
};

/// Loads and filters along x the rows from the filters' reach above a tile to as much below it.
FilteredRows filter_rows(const LinearColour& image, std::optional<double> gain,
                         const FlipFilters& filters, const FlipTile& tile) {
  const std::size_t padding = reach_of(filters);
  const std::size_t width = tile.width;
  const std::size_t rows = tile.height + 2 * padding;
  FilteredRows out;
  Contrast& contrast = out.contrast;
  for (auto* plane : {&contrast.luminance, &contrast.red_green, &contrast.blue_yellow,
                      &contrast.blue_yellow_wide, &out.smooth, &out.edge, &out.point}) {
    plane->resize(width * rows);
  }
  PaddedRow row(tile.width, padding);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto y = static_cast<std::int64_t>(tile.y + i) - static_cast<std::int64_t>(padding);
    const auto inside = std::clamp<std::int64_t>(y, 0, std::int64_t{image.height} - 1);
    row.load(image, tile.x, static_cast<std::uint32_t>(inside), gain);
    const auto filter = [&](std::size_t channel, std::size_t radius, const Taps& taps,
                            std::vector<float>& to) {
      filter_along_row(row.start(channel, radius), taps, width, to.data() + i * width);
    };
    filter(0, filters.contrast_radius, filters.luminance, contrast.luminance);
    filter(1, filters.contrast_radius, filters.red_green, contrast.red_green);
    filter(2, filters.contrast_radius, filters.blue_yellow, contrast.blue_yellow);
    filter(2, filters.contrast_radius, filters.blue_yellow_wide, contrast.blue_yellow_wide);
    filter(0, filters.feature_radius, filters.smooth, out.smooth);
    filter(0, filters.feature_radius, filters.edge, out.edge);
    filter(0, filters.feature_radius, filters.point, out.point);
  }
  return out;
}

/// Filters row `i` of a tile along y.
void filter_columns(const FilteredRows& rows, const FlipFilters& filters, std::size_t width,
                    std::size_t i, Row& out) {
  const std::size_t padding = reach_of(filters);
  const auto filter = [&](const std::vector<float>& plane, std::size_t radius, const Taps& taps,
                          std::vector<float>& to) {
    to.resize(width);
    filter_across_rows(plane.data() + (i + padding - radius) * width, width, taps, width,
                       to.data());
  };
  const Contrast& in = rows.contrast;
  Contrast& seen = out.contrast;
  const std::size_t contrast = filters.contrast_radius;
  filter(in.luminance, contrast, filters.luminance, seen.luminance);
  filter(in.red_green, contrast, filters.red_green, seen.red_green);
  filter(in.blue_yellow, contrast, filters.blue_yellow, seen.blue_yellow);
  filter(in.blue_yellow_wide, contrast, filters.blue_yellow_wide, seen.blue_yellow_wide);
  const std::size_t feature = filters.feature_radius;
  filter(rows.edge, feature, filters.smooth, out.edge_x);
  filter(rows.smooth, feature, filters.edge, out.edge_y);
  filter(rows.point, feature, filters.smooth, out.point_x);
  filter(rows.smooth, feature, filters.point, out.point_y);
}

/// Returns the perceived colour of pixel x, limited to a display's range.
glm::vec3 seen_colour(const Contrast& c, std::size_t x) {
  const float y = c.luminance[x];
  const glm::vec3 xyz(y + c.red_green[x], y, y - c.blue_yellow[x] - c.blue_yellow_wide[x]);
  glm::vec3 rgb = rgb_from_xyz(xyz);
  for (int i = 0; i < 3; ++i) rgb[i] = std::clamp(rgb[i], 0.0F, 1.0F);
  return hunt_lab_from_xyz(xyz_from_rgb(rgb));
}

float length(float x, float y) {
  return std::sqrt(x * x + y * y);
}

/// The larger of the differences between edges and between points, in [0, 1].
float feature_difference(const Row& a, const Row& b, std::size_t x) {
  const float edge = std::abs(length(a.edge_x[x], a.edge_y[x]) - length(b.edge_x[x], b.edge_y[x]));
  const float point =
      std::abs(length(a.point_x[x], a.point_y[x]) - length(b.point_x[x], b.point_y[x]));
  return std::min(std::sqrt(std::max(edge, point) * std::sqrt(0.5F)), 1.0F);
}

bool are_equal(const Contrast& a, const Contrast& b, std::size_t x) {
  return a.luminance[x] == b.luminance[x] && a.red_green[x] == b.red_green[x] &&
         a.blue_yellow[x] == b.blue_yellow[x] && a.blue_yellow_wide[x] == b.blue_yellow_wide[x];
}

float flip_at(const Row& a, const Row& b, std::size_t x) {
  // Backgrounds, and whatever is white in both at a high exposure. It saves a fifth of the time for
  // the Dragon on black.
  if (are_equal(a.contrast, b.contrast, x)) return 0.0F;
  const float colour =
      std::min(colour_difference(seen_colour(a.contrast, x), seen_colour(b.contrast, x)), 1.0F);
  // Without a difference in colour there is no error, even if 0^0 would give one.
  return colour > 0.0F ? std::pow(colour, 1.0F - feature_difference(a, b, x)) : 0.0F;
}

}  // namespace

void raise_to_ldr_flip(const LinearColour& test, const LinearColour& reference,
                       std::optional<double> exposure, const FlipFilters& filters,
                       const std::vector<FlipTile>& tiles, std::vector<float>& map,
                       Progress& progress) {
  std::optional<double> gain;
  if (exposure) gain = std::exp2(*exposure);
  tbb::parallel_for(std::size_t{0}, tiles.size(), [&](std::size_t index) {
    if (progress.cancelled()) return;
    const FlipTile& tile = tiles[index];
    const FilteredRows rows_a = filter_rows(test, gain, filters, tile);
    const FilteredRows rows_b = filter_rows(reference, gain, filters, tile);
    Row a;
    Row b;
    for (std::uint32_t i = 0; i < tile.height; ++i) {
      filter_columns(rows_a, filters, tile.width, i, a);
      filter_columns(rows_b, filters, tile.width, i, b);
      float* const out = map.data() + std::size_t{tile.y + i} * reference.width + tile.x;
      for (std::size_t x = 0; x < tile.width; ++x) out[x] = std::max(out[x], flip_at(a, b, x));
    }
    progress.advance(1);
  });
}

}  // namespace relief
