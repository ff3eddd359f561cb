#include "renderer/engines/raytrace/sampling.h"

#include <cassert>
#include <cmath>

namespace relief::raytrace {
namespace {

/// The van der Corput sequence in base 2: the binary digits mirrored at the point.
double mirror_digits(unsigned number) {
  double mirrored = 0.0;
  for (double digit = 0.5; number != 0; number >>= 1U, digit /= 2.0) {
    if ((number & 1U) != 0) mirrored += digit;
  }
  return mirrored;
}

}  // namespace

std::vector<glm::dvec2> sample_pattern(int samples) {
  assert(samples >= 1 && "a pixel needs a ray");
  std::vector<glm::dvec2> positions;
  positions.reserve(static_cast<std::size_t>(samples));
  const double half_step = 0.5 / samples;
  for (int i = 0; i < samples; ++i) {
    const double y = mirror_digits(static_cast<unsigned>(i)) + half_step;
    positions.emplace_back((i + 0.5) / samples, y - std::floor(y));
  }
  return positions;
}

}  // namespace relief::raytrace
