#include <algorithm>
#include <array>
#include <fstream>

#include "common/io/extension.h"
#include "common/io/file.h"
#include "common/io/standard_input.h"
#include "preprocess/raster/raster.h"
#include "preprocess/readers/source.h"

namespace relief {
namespace {

constexpr std::array kRasterExtensions = {".tif", ".tiff", ".dem", ".hgt", ".img",
                                          ".bil", ".flt",  ".dt0", ".dt1", ".dt2"};

std::string first_bytes(const std::filesystem::path& path) {
  std::string bytes(std::size_t{1} << 18U, '\0');
  std::ifstream file(input_path(path), std::ios::binary);
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return bytes;
}

bool is_tiff(std::string_view bytes) {
  return bytes.starts_with(std::string_view("II*\0", 4)) ||
         bytes.starts_with(std::string_view("MM\0*", 4)) ||
         bytes.starts_with(std::string_view("II+\0", 4)) ||
         bytes.starts_with(std::string_view("MM\0+", 4));
}

bool is_text_grid_file(const std::filesystem::path& path, const std::string& format,
                       std::string_view bytes) {
  if (!format.empty()) return format == kGridFormat;
  const std::string extension = lower_extension(path);
  return (extension == ".csv" || extension == ".txt") && is_grid_text(bytes);
}

}  // namespace

bool is_raster(const std::filesystem::path& path, const std::string& format) {
  if (!format.empty()) return format == kRasterFormat || format == kGridFormat;
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(input_path(path), ignored)) return false;
  const std::string bytes = first_bytes(path);
  const std::string extension = lower_extension(path);
  const bool is_named = std::any_of(kRasterExtensions.begin(), kRasterExtensions.end(),
                                    [&](std::string_view e) { return e == extension; });
  // ESRI's ASCII grids share their extension with points.
  return is_named || is_tiff(bytes) || lower_case(bytes.substr(0, 5)) == "ncols" ||
         is_text_grid_file(path, format, bytes);
}

Result<std::unique_ptr<HeightRaster>> open_raster(const std::filesystem::path& path,
                                                  const std::string& format, Progress& progress) {
  if (!is_text_grid_file(path, format, first_bytes(path))) return open_gdal_raster(path);
  RELIEF_TRY_ASSIGN(const auto bytes, read_file(path));
  return read_grid_text(path.string(), {reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                        progress);
}

}  // namespace relief
