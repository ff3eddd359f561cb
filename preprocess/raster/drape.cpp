#include "preprocess/raster/drape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <glm/common.hpp>
#include <string>

#include "common/image/image_io.h"
#include "common/io/extension.h"
#include "common/io/file.h"
#include "preprocess/raster/gdal_file.h"

namespace relief {
namespace {

/// More pixels would take more than a gigabyte.
constexpr double kMostPixels = 3e8;

/// A rectangle in the raster's coordinates.
struct Extent {
  glm::dvec2 low;
  glm::dvec2 high;
};

/// Of the cells' centres, and half a cell more on each side if `with_halves`.
Extent extent_of(const GeoGrid& grid, const RasterWindow& w, double halves) {
  const glm::dvec2 cell(grid.dx, grid.dy);
  const glm::dvec2 low(grid.x + w.column * grid.dx, grid.y - (w.row + w.rows - 1.0) * grid.dy);
  const glm::dvec2 high(grid.x + (w.column + w.columns - 1.0) * grid.dx, grid.y - w.row * grid.dy);
  return {low - halves * cell, high + halves * cell};
}

bool is_picture(const std::filesystem::path& path) {
  const std::string extension = lower_extension(path);
  return extension == ".png" || extension == ".jpg" || extension == ".jpeg";
}

/// World files of pictures: .pgw, .jgw, .wld.
bool has_world_file(std::filesystem::path path) {
  std::error_code ignored;
  for (const char* extension : {".pgw", ".jgw", ".pngw", ".jpgw", ".wld"}) {
    if (std::filesystem::exists(path.replace_extension(extension), ignored)) return true;
  }
  return false;
}

/// A picture that covers the whole raster.
Result<Drape> read_picture(const std::filesystem::path& path, const RasterInfo& raster) {
  RELIEF_TRY_ASSIGN(const auto bytes, read_file(path));
  RELIEF_TRY_ASSIGN(const auto image, decode_image(path.string(), bytes, Transfer::None));
  const std::array<const Channel*, 3> rgb = {image.find("R"), image.find("G"), image.find("B")};
  if (rgb[0] == nullptr || rgb[1] == nullptr || rgb[2] == nullptr)
    return make_error("{}: has no colours", path.string());
  Drape drape;
  drape.width = image.width;
  drape.height = image.height;
  drape.pixels.resize(std::size_t{image.width} * image.height);
  for (std::size_t k = 0; k < drape.pixels.size(); ++k) {
    for (glm::length_t c = 0; c < 3; ++c)
      drape.pixels[k][c] = static_cast<std::uint8_t>(std::lround(
          std::clamp(rgb[static_cast<std::size_t>(c)]->values[k], 0.0F, 1.0F) * 255.0F));
  }
  const Extent whole = extent_of(raster.grid, {0, 0, raster.columns, raster.rows},
                                 raster.has_coordinates ? 0.5 : 0.0);
  drape.pixel = (whole.high - whole.low) / glm::dvec2(image.width, image.height);
  drape.corner = glm::dvec2(whole.low.x, whole.high.y) + glm::dvec2(0.5, -0.5) * drape.pixel;
  return drape;
}

/// The bands that hold red, green and blue, or one of grey or of numbers of colours.
Status check_bands(const GdalFile& file) {
  const int bands = file.bands();
  for (int b = 1; b <= std::min(bands, 3); ++b) {
    if (file.gdal().type(file.band(b)) != GdalType::Byte) {
      return make_error(
          "{}: its bands are not of 8 bits; make an image of them, with "
          "`gdal_translate -ot Byte -scale IN OUT.tif`",
          file.name());
    }
  }
  return {};
}

Status check_system(const GdalFile& file, const RasterInfo& raster, const GeoGrid& grid) {
  if (grid.system.empty() || raster.grid.system.empty()) return {};
  if (grid.system == raster.grid.system && grid.in_degrees == raster.grid.in_degrees) return {};
  return make_error(
      "{}: has the coordinate system {}, but {} has {}; bring it into that one, with `gdalwarp "
      "-t_srs`",
      file.name(), grid.system, raster.name, raster.grid.system);
}

/// Replaces numbers of colours by the colours.
void look_up(const GdalFile& file, Drape& drape) {
  void* const table = file.gdal().colour_table(file.band(1));
  if (file.bands() >= 3 || table == nullptr) return;
  std::array<glm::u8vec3, 256> colours{};
  const int count = std::min(file.gdal().colour_count(table), 256);
  for (int k = 0; k < count; ++k) {
    const short* const entry = file.gdal().colour_entry(table, k);
    colours[static_cast<std::size_t>(k)] = {entry[0], entry[1], entry[2]};
  }
  for (glm::u8vec3& pixel : drape.pixels) pixel = colours[pixel.x];
}

Result<Drape> read_georeferenced(const GdalFile& file, const RasterInfo& raster,
                                 const RasterWindow& window, double most_per_cell) {
  RELIEF_TRY(check_bands(file));
  bool is_flipped = false;
  RELIEF_TRY_ASSIGN(const auto grid, file.grid(is_flipped));
  if (is_flipped)
    return make_error("{}: its rows run from south to north; turn it with `gdalwarp IN OUT.tif`",
                      file.name());
  RELIEF_TRY(check_system(file, raster, grid));
  const Extent wanted = extent_of(raster.grid, window, 0.0);
  // From the pixel before to the one behind, for interpolation.
  const auto clamp = [](double value, int most) {
    return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(most)));
  };
  const int x0 = clamp(std::floor((wanted.low.x - grid.x) / grid.dx) - 1.0, file.columns());
  const int x1 = clamp(std::ceil((wanted.high.x - grid.x) / grid.dx) + 2.0, file.columns());
  const int y0 = clamp(std::floor((grid.y - wanted.high.y) / grid.dy) - 1.0, file.rows());
  const int y1 = clamp(std::ceil((grid.y - wanted.low.y) / grid.dy) + 2.0, file.rows());
  const Extent has = extent_of(
      grid,
      {0, 0, static_cast<std::uint32_t>(file.columns()), static_cast<std::uint32_t>(file.rows())},
      0.5);
  const glm::dvec2 common =
      glm::max(glm::min(has.high, wanted.high) - glm::max(has.low, wanted.low), 0.0);
  if (x1 <= x0 || y1 <= y0 || common.x * common.y <= 0.0) {
    return make_error(
        "{}: lies elsewhere: it covers {},{} to {},{}, and the heights {},{} to {},{}", file.name(),
        has.low.x, has.low.y, has.high.x, has.high.y, wanted.low.x, wanted.low.y, wanted.high.x,
        wanted.high.y);
  }
  const auto coarser = [&](int pixels, std::uint32_t cells) {
    return std::min<double>(pixels, std::ceil(cells * most_per_cell) + 2.0);
  };
  const double width = coarser(x1 - x0, window.columns);
  const double height = coarser(y1 - y0, window.rows);
  if (width * height > kMostPixels) {
    return make_error(
        "{}: {:.0f} x {:.0f} of its pixels are too many; lower --texels-per-cell, or "
        "crop the raster with --crop",
        file.name(), width, height);
  }
  Drape drape;
  drape.width = static_cast<std::uint32_t>(width);
  drape.height = static_cast<std::uint32_t>(height);
  drape.pixels.resize(std::size_t{drape.width} * drape.height);
  const glm::dvec2 grown = glm::dvec2(x1 - x0, y1 - y0) / glm::dvec2(width, height);
  drape.pixel = grown * glm::dvec2(grid.dx, grid.dy);
  drape.corner = {grid.x + (x0 - 0.5) * grid.dx + 0.5 * drape.pixel.x,
                  grid.y - (y0 - 0.5) * grid.dy - 0.5 * drape.pixel.y};
  drape.covered =
      common.x * common.y / ((wanted.high.x - wanted.low.x) * (wanted.high.y - wanted.low.y));
  std::vector<std::uint8_t> band(drape.pixels.size());
  for (int c = 0; c < 3; ++c) {
    if (c == 0 || file.bands() >= 3) {
      RELIEF_TRY(file.read(c + 1, {x0, y0, x1 - x0, y1 - y0}, band.data(),
                           static_cast<int>(drape.width), static_cast<int>(drape.height),
                           GdalType::Byte));
    }
    for (std::size_t k = 0; k < band.size(); ++k) drape.pixels[k][c] = band[k];
  }
  look_up(file, drape);
  return drape;
}

}  // namespace

glm::u8vec3 Drape::at(glm::dvec2 place) const {
  const double x = std::clamp((place.x - corner.x) / pixel.x, 0.0, width - 1.0);
  const double y = std::clamp((corner.y - place.y) / pixel.y, 0.0, height - 1.0);
  const auto i = std::min(static_cast<std::uint32_t>(x), width - 1);
  const auto j = std::min(static_cast<std::uint32_t>(y), height - 1);
  const std::uint32_t i1 = std::min(i + 1, width - 1);
  const std::uint32_t j1 = std::min(j + 1, height - 1);
  const auto value = [&](std::uint32_t column, std::uint32_t row) {
    return glm::dvec3(pixels[std::size_t{row} * width + column]);
  };
  const glm::dvec3 above = glm::mix(value(i, j), value(i1, j), x - i);
  const glm::dvec3 below = glm::mix(value(i, j1), value(i1, j1), x - i);
  return glm::u8vec3(glm::mix(above, below, y - j) + 0.5);
}

Result<Drape> read_drape(const std::filesystem::path& path, const RasterInfo& raster,
                         const RasterWindow& window, double most_per_cell) {
  // A picture without coordinates needs no GDAL.
  if (is_picture(path) && !has_world_file(path)) return read_picture(path, raster);
  RELIEF_TRY_ASSIGN(const auto file, GdalFile::open(path));
  if (!file.has_coordinates()) {
    return make_error(
        "{}: states no coordinates; only a PNG or JPEG without them is fitted to the "
        "heights",
        file.name());
  }
  return read_georeferenced(file, raster, window, most_per_cell);
}

}  // namespace relief
