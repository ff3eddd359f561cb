// Grids of heights in files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "common/error.h"
#include "common/progress.h"
#include "preprocess/raster/geo_frame.h"

namespace relief {

/// Names of ReadOptions::format for rasters.
inline constexpr std::string_view kRasterFormat = "raster";  ///< any that GDAL reads
inline constexpr std::string_view kGridFormat = "grid";      ///< text, a row of heights a line

/// A window of cells. Column 0 is in the west, row 0 in the north.
struct RasterWindow {
  std::uint32_t column = 0;
  std::uint32_t row = 0;
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
};

/// What is known of a raster before its cells are read.
struct RasterInfo {
  std::string name;  ///< path, with which errors begin
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;
  GeoGrid grid;
  bool has_coordinates = true;  ///< false: cell (0, last row) is at 0, 0 and cells have side 1
  /// Heights are whole multiples of `step`, plus `offset`; 0: unknown (floating-point numbers).
  double step = 0.0;
  double offset = 0.0;
  double height_unit = 1.0;  ///< factor from heights to the unit of the world's x and y
};

/// An open raster. Not thread-safe.
class HeightRaster {
 public:
  HeightRaster() = default;
  virtual ~HeightRaster() = default;
  HeightRaster(const HeightRaster&) = delete;
  HeightRaster& operator=(const HeightRaster&) = delete;

  [[nodiscard]] virtual const RasterInfo& info() const = 0;
  /// Fills `heights`, row by row, in the file's unit; NaN where there is no data.
  virtual Status read(const RasterWindow& window, std::span<double> heights) = 0;
};

/// Returns whether a file is a raster: by `format` if it is not empty, otherwise by its first bytes
/// and extension. Also false if it cannot be read; reading it as points then reports why.
[[nodiscard]] bool is_raster(const std::filesystem::path& path, const std::string& format);

/// Opens a raster. Fails with one sentence if it is missing, damaged, too large, rotated, or if it
/// needs GDAL, which is not installed. Untrusted: no count is allocated unchecked.
Result<std::unique_ptr<HeightRaster>> open_raster(const std::filesystem::path& path,
                                                  const std::string& format, Progress& progress);

/// Reads a text of heights: a row a line, north first, separated by commas, semicolons or blanks;
/// nan or an empty field is a hole. `text` need not outlive the call.
Result<std::unique_ptr<HeightRaster>> read_grid_text(const std::string& name, std::string_view text,
                                                     Progress& progress);

/// Returns whether a text begins with two lines of as many numbers, 16 or more.
[[nodiscard]] bool is_grid_text(std::string_view text);

/// Opens a raster through GDAL (gdal_raster.cpp).
Result<std::unique_ptr<HeightRaster>> open_gdal_raster(const std::filesystem::path& path);

}  // namespace relief
