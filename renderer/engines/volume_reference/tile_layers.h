// The layers of a tile's pixels while splats are added to them.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <span>

#include "renderer/engines/volume_reference/tile_pixels.h"

namespace relief::volume_reference {

/// A layer for each pixel, empty at first; each sum is an array, so that a row is added in a few
/// instructions.
class TileLayers {
 public:
  void add_row(std::size_t first, std::span<const double> weights, const glm::dvec3& colour) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weight_[first + i] += weights[i];
      red_[first + i] += weights[i] * colour.r;
      green_[first + i] += weights[i] * colour.g;
      blue_[first + i] += weights[i] * colour.b;
    }
  }
  void add_normal(std::size_t pixel, const glm::dvec3& weighted) { normal_[pixel] += weighted; }
  void add_place(std::size_t pixel, double weighted) { place_[pixel] += weighted; }

  /// A pixel's layer, which is empty thereafter.
  [[nodiscard]] Layer take(std::size_t pixel) {
    const Layer layer{
        weight_[pixel], {red_[pixel], green_[pixel], blue_[pixel]}, normal_[pixel], place_[pixel]};
    weight_[pixel] = red_[pixel] = green_[pixel] = blue_[pixel] = place_[pixel] = 0.0;
    normal_[pixel] = glm::dvec3(0.0);
    return layer;
  }

 private:
  using Sums = std::array<double, TilePixels::kCount>;
  Sums weight_{};
  Sums red_{};
  Sums green_{};
  Sums blue_{};
  Sums place_{};
  std::array<glm::dvec3, TilePixels::kCount> normal_{};
};

}  // namespace relief::volume_reference
