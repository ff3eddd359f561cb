// Where in a pixel the rays go.
#pragma once

#include <glm/vec2.hpp>
#include <vector>

namespace relief::raytrace {

/// The positions of `samples` rays in a pixel, in [0, 1)^2, the same for every pixel: Hammersley's
/// set moved to the middle of its cells. One sample is the pixel's middle. The mean of the
/// positions is the middle too where `samples` is a power of two; else the image is off by up to
/// 0.05 pixels.
[[nodiscard]] std::vector<glm::dvec2> sample_pattern(int samples);

}  // namespace relief::raytrace
