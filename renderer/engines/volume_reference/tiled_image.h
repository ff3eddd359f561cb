// An image into which batches of splats are composited, front to back.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "common/progress.h"
#include "renderer/engines/volume_reference/batch.h"
#include "renderer/engines/volume_reference/tile_layers.h"
#include "renderer/engines/volume_reference/tile_pixels.h"
#include "renderer/frame/targets/film.h"
#include "renderer/volume/splats/composite_rule.h"

namespace relief::volume_reference {

/// What is kept of the splats in a pixel.
struct ImageRule {
  CompositeRule compositing;
  std::span<const glm::vec3> normals;  ///< of the cloud's kernels; none: no normals are wanted
  bool has_depth = false;
  /// The depth (along the view axis) where an opaque surface ends what a pixel shows, negative
  /// infinite where nothing is to be drawn, for each pixel of the image; none: no surface anywhere.
  std::span<const float> limits = {};
  bool is_encoded = false;  ///< whether colours are blended as encoded sRGB
};

class TiledImage {
 public:
  /// Of that many pixels.
  TiledImage(std::uint32_t width, std::uint32_t height, const ImageRule& rule);

  /// Whether a footprint lies outside of the image, or where nothing more is seen. Thread-safe
  /// while nothing is put behind.
  [[nodiscard]] bool is_hidden(const Footprint& footprint) const;
  /// Whether nothing more is seen anywhere.
  [[nodiscard]] bool is_all_done() const;

  /// Puts a batch behind what the image shows.
  void put_behind(const Batch& batch, const Progress& progress);

  /// The image as it is, and the evaluations of footprints in it. The last that is asked of it.
  [[nodiscard]] Film take_film();
  [[nodiscard]] std::uint64_t evaluations() const { return evaluations_; }

 private:
  void finish(std::size_t tile);

  Tiling tiling_;
  ImageRule rule_;
  Film film_;
  std::vector<std::unique_ptr<TilePixels>> tiles_;  ///< those that something was put into
  std::vector<std::uint8_t> is_done_;               ///< of each tile
  std::vector<std::uint64_t> evaluations_of_;       ///< likewise
  tbb::enumerable_thread_specific<TileLayers> layers_;
  std::uint64_t evaluations_ = 0;
};

}  // namespace relief::volume_reference
