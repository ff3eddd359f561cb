#include "common/compare/flip_ldr.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "common/compare/flip_colour.h"
#include "common/compare/tone_mapping.h"

namespace relief {
namespace {

/// Rows of one task. Filtering along the rows repeats the rows about them, at 67 pixels per degree
/// 20; fewer rows would repeat more, more would leave the cache.
constexpr std::uint32_t kBandRows = 64;

/// XYZ filtered for the resolution of the eye, as luminance Y and opponent colours X - Y and Y - Z:
/// the papers' YCxCz without its factors and offset, which linear filters pass on.
struct Contrast {
  std::vector<float> luminance, red_green, blue_yellow, blue_yellow_wide;
};

/// Rows of one image about a band, filtered along x.
struct FilteredRows {
  Contrast contrast;
  std::vector<float> smooth, edge, point;
};

/// One row, filtered along both axes.
struct Row {
  Contrast contrast;
  std::vector<float> edge_x, edge_y, point_x, point_y;
};

/// A row of luminance and opponent colours, continued beyond both ends for the filters.
class PaddedRow {
 public:
  PaddedRow(std::uint32_t width, std::size_t padding) : padding_(padding) {
    for (auto& channel : channels_) channel.resize(width + 2 * padding);
  }

  void load(const LinearColour& image, std::uint32_t y, std::optional<double> gain) {
    const std::size_t first = std::size_t{y} * image.width;
    const auto shown = [&](std::size_t channel, std::size_t k) {
      const float light = image.rgb[channel][k];
      return gain ? tone_map(light, *gain) : std::min(light, 1.0F);
    };
    for (std::size_t x = 0; x < image.width; ++x) {
      const std::size_t k = first + x;
      const glm::vec3 xyz = xyz_from_rgb({shown(0, k), shown(1, k), shown(2, k)});
      channels_[0][padding_ + x] = xyz.y;
      channels_[1][padding_ + x] = xyz.x - xyz.y;
      channels_[2][padding_ + x] = xyz.y - xyz.z;
    }
    for (auto& channel : channels_) {
      const std::size_t end = padding_ + image.width;
      std::fill(channel.begin(), channel.begin() + static_cast<std::ptrdiff_t>(padding_),
                channel[padding_]);
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

/// Loads and filters along x the rows from `padding` above a band to `padding` below it.
FilteredRows filter_rows(const LinearColour& image, std::optional<double> gain,
                         const FlipFilters& filters, std::uint32_t first, std::uint32_t rows) {
  const std::size_t padding = std::max(filters.contrast_radius, filters.feature_radius);
  const std::size_t width = image.width;
  FilteredRows out;
  Contrast& contrast = out.contrast;
  for (auto* plane : {&contrast.luminance, &contrast.red_green, &contrast.blue_yellow,
                      &contrast.blue_yellow_wide, &out.smooth, &out.edge, &out.point}) {
    plane->resize(width * (rows + 2 * padding));
  }
  PaddedRow row(image.width, padding);
  for (std::size_t i = 0; i < rows + 2 * padding; ++i) {
    const auto y = static_cast<std::int64_t>(first + i) - static_cast<std::int64_t>(padding);
    const auto inside = std::clamp<std::int64_t>(y, 0, std::int64_t{image.height} - 1);
    row.load(image, static_cast<std::uint32_t>(inside), gain);
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

/// Filters row `i` of a band along y.
void filter_columns(const FilteredRows& rows, const FlipFilters& filters, std::size_t width,
                    std::size_t i, Row& out) {
  const std::size_t padding = std::max(filters.contrast_radius, filters.feature_radius);
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
  // Backgrounds. It saves a fifth of the time for the Dragon on black.
  if (are_equal(a.contrast, b.contrast, x)) return 0.0F;
  const float colour =
      std::min(colour_difference(seen_colour(a.contrast, x), seen_colour(b.contrast, x)), 1.0F);
  // Without a difference in colour there is no error, even if 0^0 would give one.
  return colour > 0.0F ? std::pow(colour, 1.0F - feature_difference(a, b, x)) : 0.0F;
}

}  // namespace

void raise_to_ldr_flip(const LinearColour& test, const LinearColour& reference,
                       std::optional<double> exposure, const FlipFilters& filters,
                       std::vector<float>& map, Progress& progress) {
  const std::uint32_t width = reference.width;
  const std::uint32_t height = reference.height;
  std::optional<double> gain;
  if (exposure) gain = std::exp2(*exposure);
  const std::uint32_t bands = (height + kBandRows - 1) / kBandRows;
  tbb::parallel_for(std::uint32_t{0}, bands, [&](std::uint32_t band) {
    if (progress.cancelled()) return;
    const std::uint32_t first = band * kBandRows;
    const std::uint32_t rows = std::min(kBandRows, height - first);
    const FilteredRows rows_a = filter_rows(test, gain, filters, first, rows);
    const FilteredRows rows_b = filter_rows(reference, gain, filters, first, rows);
    Row a;
    Row b;
    for (std::uint32_t i = 0; i < rows; ++i) {
      filter_columns(rows_a, filters, width, i, a);
      filter_columns(rows_b, filters, width, i, b);
      float* const out = map.data() + std::size_t{first + i} * width;
      for (std::size_t x = 0; x < width; ++x) out[x] = std::max(out[x], flip_at(a, b, x));
    }
    progress.advance(rows);
  });
}

}  // namespace relief
