// Photographs that are laid over heights.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <vector>

#include "common/error.h"
#include "preprocess/raster/raster.h"

namespace relief {

/// The part of a photograph over some cells of a raster, in memory.
struct Drape {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<glm::u8vec3> pixels;  ///< sRGB, row-major, north first
  glm::dvec2 corner{0.0};           ///< centre of the first pixel, the raster's coordinates
  glm::dvec2 pixel{1.0};            ///< sides of a pixel, the raster's coordinates
  double covered = 1.0;             ///< share of the cells' extent that it covers

  /// Returns the colour at a place, bilinear; beyond the photograph that of its edge.
  [[nodiscard]] glm::u8vec3 at(glm::dvec2 place) const;
};

/// Reads the part of a photograph over the cells of `window`, made coarser if it has more than
/// `most_per_cell` pixels along a cell's side. A georeferenced one (through GDAL) must have the
/// raster's coordinate system; a PNG or JPEG without coordinates fits to the whole raster. Fails
/// with one sentence: missing, damaged, no colours of 8 bits, another coordinate system, elsewhere.
Result<Drape> read_drape(const std::filesystem::path& path, const RasterInfo& raster,
                         const RasterWindow& window, double most_per_cell);

}  // namespace relief
