// Converts a raster of heights to patches, without resampling.
#pragma once

#include <filesystem>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/convert_options.h"
#include "preprocess/readers/selection.h"
#include "preprocess/texture/files/load_textures.h"

namespace relief {

/// Converts a raster. Its cells are the samples: tiles of up to 256 x 256 cells are patches, which
/// overlap their neighbours by one cell; base planes are horizontal, spacing and height step are
/// the raster's own, and cells without data are holes. x is east, y north, z up. Degrees become
/// metres about the raster's centre (geo_frame.h); a note says so. `texture` is laid over the
/// heights. `read.selection.crop` is in the raster's own coordinates.
///
/// Options: height_step, texels_per_cell and threads; spacing sets the side of cells of grids
/// without coordinates. Fails with one sentence if others are set, if nothing is left, if the model
/// would not fit into memory, or as open_raster and read_drape do.
Result<ConvertResult> convert_raster(const std::filesystem::path& path,
                                     const TextureChoice& texture, const ConvertOptions& options,
                                     const ReadOptions& read, Progress& progress);

}  // namespace relief
