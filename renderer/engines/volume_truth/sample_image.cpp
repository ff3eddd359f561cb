#include "renderer/engines/volume_truth/sample_image.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/vec4.hpp>

#include "renderer/volume/volume_model.h"

namespace relief::volume_truth {
namespace {

/// Weights of the rays from kFilterReach pixels before a pixel's own to as many after it; their sum
/// is 1.
std::vector<double> filter_weights(int side) {
  std::vector<double> weights(static_cast<std::size_t>((2 * kFilterReach + 1) * side));
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) {
    const double from_middle = (static_cast<double>(k) + 0.5) / side - kFilterReach - 0.5;
    sum += weights[k] = std::exp(-0.5 * from_middle * from_middle);
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

glm::dvec4 shown(const RaySum& ray, bool is_encoded) {
  const double alpha = 1.0 - ray.transmittance;
  if (!(alpha > 0.0)) return glm::dvec4(0.0);
  return {is_encoded ? decoded(ray.colour, alpha) : ray.colour, alpha};
}

}  // namespace

Film filtered(const SampleImage& image, const View& view, bool is_encoded) {
  Film film{view.width, view.height, std::vector<FilmPixel>(std::size_t{view.width} * view.height),
            is_encoded};
  const std::vector<double> weights =
      image.side > 1 ? filter_weights(image.side) : std::vector<double>{1.0};
  const auto taps = static_cast<std::int64_t>(weights.size());
  // Along the rows first.
  std::vector<glm::dvec4> rows(static_cast<std::size_t>(image.height) * view.width);
  tbb::parallel_for(std::int64_t{0}, image.height, [&](std::int64_t y) {
    for (std::int64_t x = 0; x < view.width; ++x) {
      glm::dvec4& sum = rows[static_cast<std::size_t>(y * view.width + x)];
      for (std::int64_t k = 0; k < taps; ++k) {
        sum += weights[static_cast<std::size_t>(k)] *
               shown(image.rays[image.index(x * image.side + k, y)], is_encoded);
      }
    }
  });
  tbb::parallel_for(std::int64_t{0}, std::int64_t{view.height}, [&](std::int64_t y) {
    for (std::int64_t x = 0; x < view.width; ++x) {
      glm::dvec4 sum(0.0);
      for (std::int64_t k = 0; k < taps; ++k) {
        sum += weights[static_cast<std::size_t>(k)] *
               rows[static_cast<std::size_t>((y * image.side + k) * view.width + x)];
      }
      FilmPixel& pixel = film.pixels[static_cast<std::size_t>(y * view.width + x)];
      pixel.colour = glm::vec4(sum);
      const std::int64_t middle = image.side / 2 + image.border * image.side;
      pixel.depth = static_cast<float>(
          image.rays[image.index(x * image.side + middle, y * image.side + middle)].depth);
    }
  });
  return film;
}

}  // namespace relief::volume_truth
