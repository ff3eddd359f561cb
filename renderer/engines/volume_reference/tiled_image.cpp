#include "renderer/engines/volume_reference/tiled_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "renderer/engines/volume_reference/composite.h"
#include "renderer/volume/volume_model.h"

namespace relief::volume_reference {
namespace {

FilmPixel film_pixel(const VolumePixel& shown, bool is_encoded) {
  FilmPixel pixel;
  const double alpha = 1.0 - shown.transmittance;
  if (!(alpha > 0.0)) return pixel;
  pixel.colour =
      glm::vec4(glm::dvec4(is_encoded ? decoded(shown.colour, alpha) : shown.colour, alpha));
  const double length = glm::length(shown.normal);
  if (length > 0.0) pixel.normal = glm::vec3(shown.normal / length);
  pixel.depth = static_cast<float>(shown.depth);
  return pixel;
}

}  // namespace

TiledImage::TiledImage(std::uint32_t width, std::uint32_t height, const ImageRule& rule)
    : tiling_{width, height},
      rule_(rule),
      film_{width, height, std::vector<FilmPixel>(std::size_t{width} * height)},
      tiles_(tiling_.count()),
      is_done_(tiling_.count(), 0),
      evaluations_of_(tiling_.count(), 0) {}

bool TiledImage::is_hidden(const Footprint& footprint) const {
  const PixelBox tiles = tiles_of(footprint, tiling_);
  for (std::int64_t row = tiles.top; row <= tiles.bottom; ++row) {
    for (std::int64_t column = tiles.left; column <= tiles.right; ++column) {
      if (is_done_[static_cast<std::size_t>(row * tiling_.columns() + column)] == 0) return false;
    }
  }
  return true;
}

bool TiledImage::is_all_done() const {
  return std::find(is_done_.begin(), is_done_.end(), 0) == is_done_.end();
}

void TiledImage::put_behind(const Batch& batch, const Progress& progress) {
  const TileLists lists(tiling_, batch.splats, batch.order);
  const Composition composition{batch.splats, batch.colours,     rule_.normals, rule_.has_depth,
                                batch.order,  rule_.compositing, tiling_.height};
  tbb::parallel_for(std::size_t{0}, tiling_.count(), [&](std::size_t tile) {
    const std::span<const OrderedSplat> list = lists.list(tile);
    if (is_done_[tile] != 0 || list.empty() || progress.cancelled()) return;
    std::unique_ptr<TilePixels>& pixels = tiles_[tile];
    if (pixels == nullptr)
      pixels = std::make_unique<TilePixels>(tiling_.box(tile), rule_.limits, tiling_.width);
    evaluations_of_[tile] += composite_tile(composition, list, layers_.local(), *pixels);
    if (pixels->is_all_done()) finish(tile);
  });
}

/// Nothing more is put into a tile.
void TiledImage::finish(std::size_t tile) {
  is_done_[tile] = 1;
  if (tiles_[tile] == nullptr) return;
  const TilePixels& pixels = *tiles_[tile];
  const PixelBox& box = pixels.box();
  for (std::int64_t y = box.top; y <= box.bottom; ++y) {
    for (std::int64_t x = box.left; x <= box.right; ++x) {
      film_.pixels[static_cast<std::size_t>(y * tiling_.width + x)] =
          film_pixel(pixels[pixels.index(x, y)], rule_.is_encoded);
    }
  }
  tiles_[tile].reset();
}

Film TiledImage::take_film() {
  tbb::parallel_for(std::size_t{0}, tiling_.count(), [&](std::size_t tile) { finish(tile); });
  for (const std::uint64_t count : evaluations_of_) evaluations_ += count;
  return std::move(film_);
}

}  // namespace relief::volume_reference
