#include "renderer/shading/environment/irradiance.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace relief {
namespace {

using Harmonics = std::array<double, 9>;

/// The polynomials of the harmonics, in the order of Frame::irradiance.
Harmonics polynomials(glm::dvec3 n) {
  return {1.0,
          n.y,
          n.z,
          n.x,
          n.x * n.y,
          n.y * n.z,
          3.0 * n.z * n.z - 1.0,
          n.x * n.z,
          n.x * n.x - n.y * n.y};
}

/// For each polynomial: the square of its harmonic's factor, as it is used twice, times what a
/// surface's cosine keeps of its order, over pi: 1, 2/3 and 1/4.
constexpr double kOrder0 = 0.282095 * 0.282095;
constexpr double kOrder1 = 0.488603 * 0.488603 * 2.0 / 3.0;
constexpr double kOrder2 = 1.092548 * 1.092548 / 4.0;
constexpr Harmonics kFactors{kOrder0,
                             kOrder1,
                             kOrder1,
                             kOrder1,
                             kOrder2,
                             kOrder2,
                             0.315392 * 0.315392 / 4.0,
                             kOrder2,
                             0.546274 * 0.546274 / 4.0};

}  // namespace

std::array<glm::vec4, 9> irradiance_of(const CubeMap& environment) {
  std::array<glm::dvec3, 9> sums{};
  const double size = environment.size;
  for (std::size_t face = 0; face < environment.faces.size(); ++face) {
    for (std::size_t i = 0; i < environment.faces[face].size(); ++i) {
      const std::size_t column = i % environment.size;
      const std::size_t row = i / environment.size;
      const glm::dvec2 texel(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
      const glm::dvec3 along = cube_direction(face, 2.0 * texel / size - 1.0);
      const double length = glm::length(along);
      // The texel's solid angle: its side is 2 / size at distance 1.
      const double angle = 4.0 / (size * size * length * length * length);
      const Harmonics values = polynomials(along / length);
      const glm::dvec3 light = angle * glm::dvec3(environment.faces[face][i]);
      for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += values[k] * light;
    }
  }
  std::array<glm::vec4, 9> coefficients{};
  for (std::size_t k = 0; k < sums.size(); ++k)
    coefficients[k] = glm::vec4(glm::vec3(kFactors[k] * sums[k]), 0.0F);
  return coefficients;
}

}  // namespace relief
