// Analytic surfaces with known distance and normal, sampled like scans: what the preprocessing is
// held against.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <numbers>
#include <random>

#include "common/points.h"

namespace relief::test {

/// An analytic surface: signed distance (to first order for the saddle) and outward normal.
struct Plane {
  [[nodiscard]] double distance(glm::dvec3 p) const { return p.z; }
  [[nodiscard]] glm::dvec3 normal(glm::dvec3 /*p*/) const { return {0, 0, 1}; }
};

struct Sphere {
  double radius = 1.0;
  [[nodiscard]] double distance(glm::dvec3 p) const { return glm::length(p) - radius; }
  [[nodiscard]] glm::dvec3 normal(glm::dvec3 p) const { return glm::normalize(p); }
};

/// z = curvature (x^2 - y^2) / 2
struct Saddle {
  double curvature = 1.0;
  [[nodiscard]] double height(double x, double y) const {
    return 0.5 * curvature * (x * x - y * y);
  }
  [[nodiscard]] glm::dvec3 normal(glm::dvec3 p) const {
    return glm::normalize(glm::dvec3(-curvature * p.x, curvature * p.y, 1.0));
  }
  [[nodiscard]] double distance(glm::dvec3 p) const {
    return (p.z - height(p.x, p.y)) * normal(p).z;
  }
};

/// Around the z axis.
struct Torus {
  double major = 1.0;
  double minor = 0.4;
  [[nodiscard]] glm::dvec3 centre_of_tube(glm::dvec3 p) const {
    const double r = std::hypot(p.x, p.y);
    return {p.x * major / r, p.y * major / r, 0.0};
  }
  [[nodiscard]] double distance(glm::dvec3 p) const {
    return glm::length(p - centre_of_tube(p)) - minor;
  }
  [[nodiscard]] glm::dvec3 normal(glm::dvec3 p) const {
    return glm::normalize(p - centre_of_tube(p));
  }
};

/// A mesh of squares from the origin on, each of two triangles halved along the diagonal from its
/// first corner, at height(x, y).
template <class Height>
Points square_mesh(glm::uvec2 squares, double side, const Height& height) {
  Points mesh;
  for (std::uint32_t j = 0; j <= squares.y; ++j) {
    for (std::uint32_t i = 0; i <= squares.x; ++i)
      mesh.positions.emplace_back(i * side, j * side, height(i * side, j * side));
  }
  for (std::uint32_t j = 0; j < squares.y; ++j) {
    for (std::uint32_t i = 0; i < squares.x; ++i) {
      const std::uint32_t a = j * (squares.x + 1) + i;
      const std::uint32_t b = a + squares.x + 1;
      mesh.triangles.push_back({a, a + 1, b + 1});
      mesh.triangles.push_back({a, b + 1, b});
    }
  }
  return mesh;
}

/// A jittered grid over [-half, half]^2 lifted by height(x, y); spacing `step`.
template <class Height>
Points sample_height_field(double half, double step, Height&& height, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.3 * step, 0.3 * step);
  Points points;
  for (double y = -half; y <= half; y += step) {
    for (double x = -half; x <= half; x += step) {
      const double a = x + jitter(random);
      const double b = y + jitter(random);
      points.positions.emplace_back(a, b, height(a, b));
    }
  }
  return points;
}

/// `count` well-spread points on the unit sphere times `radius` (Fibonacci lattice, jittered).
inline Points sample_sphere(std::size_t count, double radius = 1.0, unsigned seed = 1) {
  std::mt19937 random(seed);
  const double spacing = std::sqrt(4.0 * std::numbers::pi / static_cast<double>(count));
  std::normal_distribution<double> jitter(0.0, 0.15 * spacing);
  Points points;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(count);
    const double angle = static_cast<double>(i) * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const double r = std::sqrt(1.0 - z * z);
    const glm::dvec3 p(r * std::cos(angle) + jitter(random), r * std::sin(angle) + jitter(random),
                       z + jitter(random));
    points.positions.push_back(radius * glm::normalize(p));
  }
  return points;
}

/// A torus sampled with about `step` between points.
inline Points sample_torus(const Torus& torus, double step, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> jitter(-0.3, 0.3);
  Points points;
  const int around_tube = static_cast<int>(2.0 * std::numbers::pi * torus.minor / step);
  for (int a = 0; a < around_tube; ++a) {
    const double tube = 2.0 * std::numbers::pi * (a + jitter(random)) / around_tube;
    const double ring = torus.major + torus.minor * std::cos(tube);
    const int around = static_cast<int>(2.0 * std::numbers::pi * ring / step);
    for (int b = 0; b < around; ++b) {
      const double angle = 2.0 * std::numbers::pi * (b + jitter(random)) / around;
      points.positions.emplace_back(ring * std::cos(angle), ring * std::sin(angle),
                                    torus.minor * std::sin(tube));
    }
  }
  return points;
}

}  // namespace relief::test
