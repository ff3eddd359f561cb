// Random scans of known surfaces with noise.
#pragma once

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>
#include <vector>

namespace relief::test {

/// Points spread at random, as scans that are merged are; `spacing`: the side of the square that
/// holds one on average.
struct RandomScan {
  std::vector<glm::dvec3> positions;
  double spacing = 0.0;
};

/// [0, 1]^2 at z = 0.
inline RandomScan random_plane(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  RandomScan scan{{}, std::sqrt(1.0 / static_cast<double>(count))};
  for (std::size_t i = 0; i < count; ++i) scan.positions.emplace_back(any(random), any(random), 0);
  return scan;
}

/// The unit sphere.
inline RandomScan random_sphere(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  RandomScan scan{{}, std::sqrt(4.0 * std::numbers::pi / static_cast<double>(count))};
  for (std::size_t i = 0; i < count; ++i)
    scan.positions.push_back(
        glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  return scan;
}

/// The surface of [0, 1]^3.
inline RandomScan random_cube(std::size_t count, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  RandomScan scan{{}, std::sqrt(6.0 / static_cast<double>(count))};
  for (std::size_t i = 0; i < count; ++i) {
    glm::dvec3 p(0.0);
    const auto axis = static_cast<glm::length_t>(i % 3);
    p[axis] = i % 6 < 3 ? 0.0 : 1.0;
    p[(axis + 1) % 3] = any(random);
    p[(axis + 2) % 3] = any(random);
    scan.positions.push_back(p);
  }
  return scan;
}

inline double distance_to_cube(glm::dvec3 p) {
  const glm::dvec3 beyond = glm::abs(p - 0.5) - 0.5;
  const double inside = std::max({beyond.x, beyond.y, beyond.z});
  return inside < 0.0 ? -inside : glm::length(glm::max(beyond, 0.0));
}

/// Adds noise of that many spacings along each axis.
inline std::vector<glm::dvec3> with_noise(const RandomScan& scan, double spacings,
                                          unsigned seed = 2) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, spacings * scan.spacing);
  std::vector<glm::dvec3> positions = scan.positions;
  for (glm::dvec3& p : positions) p += glm::dvec3(noise(random), noise(random), noise(random));
  return positions;
}

}  // namespace relief::test
