#include "renderer/eye_dome.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "shaders/include/shared.h"

namespace relief {
namespace {

constexpr double kRadius = shared::kEyeDomeRadius;

/// A camera with a field of view of 45 degrees sees as much at so many times the image's height as
/// an orthographic one: steps of depth there are as those of a perspective image.
constexpr double kDistance = 1.207;

/// What steps are measured in: log2 of the depth, or depth over that of a perspective camera.
std::vector<float> depth_measure(const Channel& depth, const Camera& camera) {
  std::vector<float> measure(depth.values.size());
  const double scale = eye_dome_scale(camera);
  std::transform(depth.values.begin(), depth.values.end(), measure.begin(), [&](float z) {
    if (!std::isfinite(z)) return z;
    return static_cast<float>(scale > 0.0 ? scale * z : std::log2(std::max(double{z}, 1e-300)));
  });
  return measure;
}

}  // namespace

double eye_dome_scale(const Camera& camera) {
  return camera.is_orthographic() ? 1.0 / (kDistance * camera.orthographic_height * std::log(2.0))
                                  : 0.0;
}

void shade_eye_dome(Image& image, const Camera& camera, double strength) {
  const Channel* const depth = image.find("Z");
  assert(depth != nullptr && "an image with depth");
  const std::vector<float> measure = depth_measure(*depth, camera);
  const auto width = static_cast<std::int64_t>(image.width);
  const auto height = static_cast<std::int64_t>(image.height);
  const auto radius = std::max<std::int64_t>(1, std::llround(kRadius * image.height));
  const std::int64_t diagonal =
      std::max<std::int64_t>(1, std::llround(0.7071 * kRadius * image.height));
  const std::array<std::pair<std::int64_t, std::int64_t>, 8> neighbours{{{radius, 0},
                                                                         {-radius, 0},
                                                                         {0, radius},
                                                                         {0, -radius},
                                                                         {diagonal, diagonal},
                                                                         {-diagonal, diagonal},
                                                                         {diagonal, -diagonal},
                                                                         {-diagonal, -diagonal}}};
  std::vector<float> shade(measure.size(), 1.0F);
  tbb::parallel_for(std::int64_t{0}, height, [&](std::int64_t y) {
    for (std::int64_t x = 0; x < width; ++x) {
      const auto at = static_cast<std::size_t>(y * width + x);
      if (!std::isfinite(measure[at])) continue;
      double steps = 0.0;
      for (const auto& [dx, dy] : neighbours) {
        const std::int64_t column = x + dx;
        const std::int64_t row = y + dy;
        if (column < 0 || row < 0 || column >= width || row >= height) continue;
        const float beside = measure[static_cast<std::size_t>(row * width + column)];
        if (beside < measure[at]) steps += measure[at] - beside;
      }
      shade[at] = static_cast<float>(std::exp(-double{shared::kEyeDomeFactor} * strength * steps /
                                              static_cast<double>(neighbours.size())));
    }
  });
  for (Channel& channel : image.channels) {
    if (channel.name != "R" && channel.name != "G" && channel.name != "B") continue;
    for (std::size_t i = 0; i < shade.size(); ++i) channel.values[i] *= shade[i];
  }
}

}  // namespace relief
