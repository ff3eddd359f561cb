#include "cli/bench/bench_rows.h"

#include <algorithm>
#include <cassert>

namespace relief::cli {

namespace {

/// What all rows have.
RenderSettings plain(RenderSettings base) {
  base.background.reset();
  base.outputs = {};
  base.pixels_per_sample.reset();
  return base;
}

/// Pixels a sample: the finest levels, those that are there unasked, twice as coarse ones, and what
/// is asked for beside them.
std::vector<double> level_policies(const RenderSettings& base) {
  std::vector<double> policies{0.0, kPixelsPerSampleOfCells, 2.0 * kPixelsPerSampleOfCells};
  const double asked = base.pixels_per_sample.value_or(0.0);
  if (std::find(policies.begin(), policies.end(), asked) == policies.end())
    policies.push_back(asked);
  return policies;
}

}  // namespace

std::vector<RenderSettings> bench_rows(const RenderSettings& base) {
  RenderSettings row = plain(base);
  row.engine = "onepass";
  std::vector<RenderSettings> rows;
  for (const Primitive primitive : {Primitive::Sprite, Primitive::Quad}) {
    for (const Interpolation interpolation : {Interpolation::Direct, Interpolation::Corrected}) {
      row.primitive = primitive;
      row.interpolation = interpolation;
      rows.push_back(row);
    }
  }
  for (const RenderSettings& cells : level_rows(base, level_policies(base))) rows.push_back(cells);
  row.engine = "multipass";
  row.interpolation = RenderSettings{}.interpolation;
  for (const Primitive primitive : {Primitive::Sprite, Primitive::Quad}) {
    for (const double radius_factor : {1.0, 2.0}) {
      row.primitive = primitive;
      row.multipass.radius_factor = radius_factor;
      rows.push_back(row);
    }
  }
  return rows;
}

std::vector<RenderSettings> compared_rows(const RenderSettings& base) {
  const RenderSettings unasked;
  RenderSettings row = plain(base);
  row.engine = unasked.engine;
  row.primitive = unasked.primitive;
  row.interpolation = unasked.interpolation;
  row.multipass = unasked.multipass;
  std::vector<RenderSettings> rows{row};
  for (const RenderSettings& rival : radius_factor_rows(base, {MultipassSettings{}.radius_factor}))
    rows.push_back(rival);
  return rows;
}

std::vector<RenderSettings> radius_factor_rows(const RenderSettings& base,
                                               const std::vector<double>& factors) {
  RenderSettings row = plain(base);
  row.engine = "multipass";
  row.primitive = Primitive::Quad;
  std::vector<RenderSettings> rows;
  rows.reserve(factors.size());
  for (const double factor : factors) {
    row.multipass.radius_factor = factor;
    rows.push_back(row);
  }
  return rows;
}

std::vector<RenderSettings> level_rows(const RenderSettings& base,
                                       const std::vector<double>& pixels) {
  RenderSettings row = plain(base);
  row.engine = "onepass";
  row.primitive = Primitive::Cell;
  row.interpolation = RenderSettings{}.interpolation;
  std::vector<RenderSettings> rows(pixels.size(), row);
  for (std::size_t k = 0; k < pixels.size(); ++k) rows[k].pixels_per_sample = pixels[k];
  return rows;
}

bool is_default(const RenderSettings& row) {
  const RenderSettings unasked;
  if (row.engine != unasked.engine || row.primitive != unasked.primitive ||
      pixels_per_sample_of(row) != pixels_per_sample_of(unasked))
    return false;
  return row.engine == "onepass" ? row.interpolation == unasked.interpolation
                                 : row.multipass.radius_factor == unasked.multipass.radius_factor;
}

std::size_t find_default(const std::vector<RenderSettings>& rows) {
  const auto found = std::find_if(rows.begin(), rows.end(), is_default);
  assert(found != rows.end() && "one row is the default");
  return static_cast<std::size_t>(found - rows.begin());
}

}  // namespace relief::cli
