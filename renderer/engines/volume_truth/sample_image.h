// The rays of an image, and what pixels show of them.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "renderer/engines/volume_truth/ray_sum.h"
#include "renderer/frame/targets/film.h"
#include "renderer/view/view.h"

namespace relief::volume_truth {

/// The standard deviation of the pixel filter, pixels, is 1: that of the low-pass filter of
/// [Zwicker 2002]. It is cut where it has fallen to 3e-4.
inline constexpr int kFilterReach = 4;

/// A square grid of rays over the image, `side` along a pixel's side. With several it reaches
/// kFilterReach pixels beyond the image. Rows from the top.
struct SampleImage {
  SampleImage(const View& view, int side_of_pixel)
      : side(side_of_pixel),
        border(side > 1 ? kFilterReach : 0),
        width((std::int64_t{view.width} + std::int64_t{2} * border) * side),
        height((std::int64_t{view.height} + std::int64_t{2} * border) * side),
        image_height(view.height),
        rays(static_cast<std::size_t>(width * height)) {}

  /// Pixels from the lower left corner of the image.
  [[nodiscard]] glm::dvec2 window(std::int64_t x, std::int64_t y) const {
    return {(static_cast<double>(x) + 0.5) / side - border,
            image_height - (static_cast<double>(y) + 0.5) / side + border};
  }
  [[nodiscard]] std::size_t index(std::int64_t x, std::int64_t y) const {
    return static_cast<std::size_t>(y * width + x);
  }

  int side;
  int border;
  std::int64_t width;
  std::int64_t height;
  double image_height;
  std::vector<RaySum> rays;
};

/// The image: its pixels are the rays, or with several a pixel their means, weighted by a Gaussian
/// about its middle. Depths are those of the rays beside the middles. `is_encoded`: the colours
/// have been blended as encoded sRGB.
[[nodiscard]] Film filtered(const SampleImage& image, const View& view, bool is_encoded);

}  // namespace relief::volume_truth
