#include "cli/bench_rows.h"

#include <algorithm>
#include <cassert>

namespace relief::cli {

std::vector<RenderSettings> bench_rows(const RenderSettings& base) {
  RenderSettings row = base;
  row.background.reset();
  row.outputs = {};
  row.engine = EngineKind::Onepass;
  std::vector<RenderSettings> rows;
  for (const Primitive primitive : {Primitive::Sprite, Primitive::Quad}) {
    for (const Interpolation interpolation : {Interpolation::Direct, Interpolation::Corrected}) {
      row.primitive = primitive;
      row.interpolation = interpolation;
      rows.push_back(row);
    }
  }
  row.primitive = Primitive::Cell;
  row.interpolation = RenderSettings{}.interpolation;
  rows.push_back(row);
  row.engine = EngineKind::Multipass;
  for (const Primitive primitive : {Primitive::Sprite, Primitive::Quad}) {
    for (const double radius_factor : {1.0, 2.0}) {
      row.primitive = primitive;
      row.multipass.radius_factor = radius_factor;
      rows.push_back(row);
    }
  }
  return rows;
}

bool is_default(const RenderSettings& row) {
  const RenderSettings unasked;
  if (row.engine != unasked.engine || row.primitive != unasked.primitive) return false;
  return row.engine == EngineKind::Onepass
             ? row.interpolation == unasked.interpolation
             : row.multipass.radius_factor == unasked.multipass.radius_factor;
}

std::size_t find_default(const std::vector<RenderSettings>& rows) {
  assert(std::count_if(rows.begin(), rows.end(), is_default) == 1 && "one row is the default");
  return static_cast<std::size_t>(std::find_if(rows.begin(), rows.end(), is_default) -
                                  rows.begin());
}

}  // namespace relief::cli
