// One patch of a raster.
#pragma once

#include <optional>
#include <span>

#include "common/patch.h"
#include "preprocess/raster/drape.h"
#include "preprocess/raster/geo_frame.h"
#include "preprocess/raster/raster.h"

namespace relief {

/// What all patches of a raster share.
struct RasterPlan {
  RasterInfo info;  ///< of square cells
  GeoFrame frame;
  RasterWindow window;  ///< the cells to convert
  double spacing = 1.0;
  double height_unit = 1.0;  ///< world units per unit of the file's heights
  double step = 1.0;         ///< height step, in the file's unit
  double offset = 0.0;       ///< heights are multiples of `step` plus this
  const Drape* drape = nullptr;
  std::uint32_t texels_per_cell = 1;  ///< of the drape
};

/// Heights of some rows of all columns of the plan's window, with a row more on each side.
struct RasterBand {
  std::uint32_t columns = 0;
  std::uint32_t first_row = 0;  ///< of the whole raster
  std::uint32_t rows = 0;
  std::vector<double> heights;

  /// NaN outside. Column and row of the whole raster; `west`: the plan's first column.
  [[nodiscard]] double at(std::int64_t column, std::int64_t row, std::uint32_t west) const;
};

/// Distances of a patch's samples to the heights that they stand for.
struct RasterError {
  std::uint64_t cells = 0;
  double sum_of_squares = 0.0;  ///< world units
  double largest = 0.0;
  bool is_coarser = false;  ///< its heights span too many of the plan's steps
};

/// Makes the patch of a tile of cells; nothing if none of them has data.
[[nodiscard]] std::optional<Patch> make_raster_patch(const RasterPlan& plan, const RasterBand& band,
                                                     const RasterWindow& tile, RasterError& error);

}  // namespace relief
