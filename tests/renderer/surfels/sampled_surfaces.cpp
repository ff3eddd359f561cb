#include "tests/renderer/surfels/sampled_surfaces.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <map>
#include <numbers>
#include <random>
#include <tuple>

namespace relief::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kMajor = 1.0;
constexpr double kMinor = 0.4;
constexpr double kPlaneHalf = 1.1;

/// A place on a surface by two numbers from 0 to 1, uniform by area.
struct Place {
  glm::dvec3 position;
  glm::dvec3 normal;
};

/// The share of the torus' area below an angle about the tube is
/// (angle + minor/major sin(angle)) / (2 pi), which Newton's method inverts.
double torus_angle(double share) {
  double angle = 2.0 * kPi * share;
  for (int step = 0; step < 20; ++step) {
    const double value = angle + kMinor / kMajor * std::sin(angle) - 2.0 * kPi * share;
    angle -= value / (1.0 + kMinor / kMajor * std::cos(angle));
  }
  return angle;
}

Place place_at(Shape shape, double a, double b, double plane_half) {
  switch (shape) {
    case Shape::Plane:
      return {{plane_half * (2.0 * a - 1.0), plane_half * (2.0 * b - 1.0), 0.0}, {0, 0, 1}};
    case Shape::Sphere: {
      const double z = 1.0 - 2.0 * b;
      const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
      const glm::dvec3 at(r * std::cos(2.0 * kPi * a), r * std::sin(2.0 * kPi * a), z);
      return {at, at};
    }
    case Shape::Torus:
      break;
  }
  const double around = 2.0 * kPi * a;
  const double tube = torus_angle(b);
  const glm::dvec3 out(std::cos(around), std::sin(around), 0.0);
  const glm::dvec3 normal = std::cos(tube) * out + glm::dvec3(0, 0, std::sin(tube));
  return {kMajor * out + kMinor * normal, normal};
}

double area_of(Shape shape) {
  switch (shape) {
    case Shape::Plane:
      return 4.0 * kPlaneHalf * kPlaneHalf;
    case Shape::Sphere:
      return 4.0 * kPi;
    case Shape::Torus:
      break;
  }
  return 4.0 * kPi * kPi * kMajor * kMinor;
}

void add(SampledSurface& surface, const Place& place) {
  surface.positions.push_back(place.position);
  surface.normals.emplace_back(place.normal);
}

/// Darts, of which those are kept that hit farther than `apart` from all before.
SampledSurface throw_darts(Shape shape, std::size_t points, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  // Discs of that diameter that do not overlap reach 0.55 of the plane after so many darts.
  const double apart = std::sqrt(4.0 * 0.52 * area_of(shape) / (kPi * static_cast<double>(points)));
  std::map<std::tuple<int, int, int>, std::vector<glm::dvec3>> cells;
  const auto cell_of = [apart](double x) { return static_cast<int>(std::floor(x / apart)); };
  SampledSurface surface;
  for (std::size_t dart = 0; dart < 60 * points; ++dart) {
    const Place place = place_at(shape, uniform(random), uniform(random), kPlaneHalf);
    const glm::dvec3 p = place.position;
    bool is_free = true;
    for (int m = 0; m < 27 && is_free; ++m) {
      const auto near = cells.find(
          {cell_of(p.x) + m % 3 - 1, cell_of(p.y) + m / 3 % 3 - 1, cell_of(p.z) + m / 9 - 1});
      if (near == cells.end()) continue;
      is_free = std::ranges::none_of(
          near->second, [&](glm::dvec3 other) { return glm::distance(other, p) < apart; });
    }
    if (!is_free) continue;
    cells[{cell_of(p.x), cell_of(p.y), cell_of(p.z)}].push_back(p);
    add(surface, place);
  }
  return surface;
}

/// Rows of cells that are as long as high, each point anywhere in its cell.
SampledSurface jitter_grid(Shape shape, std::size_t points, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  const double side = std::sqrt(area_of(shape) / static_cast<double>(points));
  SampledSurface surface;
  // Rows by height on the plane, by angle on the sphere and about the torus' tube.
  const double across = shape == Shape::Plane    ? 2.0 * kPlaneHalf
                        : shape == Shape::Sphere ? kPi
                                                 : 2.0 * kPi * kMinor;
  const auto rows = static_cast<int>(std::round(across / side));
  for (int row = 0; row < rows; ++row) {
    const double middle = (row + 0.5) / rows;
    const double length = shape == Shape::Plane ? 2.0 * kPlaneHalf
                          : shape == Shape::Sphere
                              ? 2.0 * kPi * std::sin(kPi * middle)
                              : 2.0 * kPi * (kMajor + kMinor * std::cos(2.0 * kPi * middle));
    const auto columns = std::max(static_cast<int>(std::round(length / side)), 1);
    for (int column = 0; column < columns; ++column) {
      const double a = (column + uniform(random)) / columns;
      const double at = (row + uniform(random)) / rows;
      double b = at;
      if (shape == Shape::Sphere) b = 0.5 * (1.0 - std::cos(kPi * at));
      if (shape == Shape::Torus)
        b = (2.0 * kPi * at + kMinor / kMajor * std::sin(2.0 * kPi * at)) / (2.0 * kPi);
      add(surface, place_at(shape, a, b, kPlaneHalf));
    }
  }
  return surface;
}

/// A function that is 0 on the surface, below 0 inside; the plane is tilted, as no scan is aligned
/// with its grid.
double inside(Shape shape, glm::dvec3 p) {
  switch (shape) {
    case Shape::Plane:
      return glm::dot(p, glm::normalize(glm::dvec3(0.31, 0.47, 1.0)));
    case Shape::Sphere:
      return glm::length(p) - 1.0;
    case Shape::Torus:
      break;
  }
  const double from_ring = std::hypot(p.x, p.y) - kMajor;
  return std::hypot(from_ring, p.z) - kMinor;
}

/// Where the edges of a cubic grid cross the surface.
SampledSurface cross_grid(Shape shape, std::size_t points) {
  // A surface's projections on the three planes are 1.5 times its area, on average.
  const double cell = std::sqrt(1.5 * area_of(shape) / static_cast<double>(points));
  const double reach = shape == Shape::Plane ? 1.6 : 1.5;
  const auto half = static_cast<int>(std::ceil(reach / cell));
  const glm::dvec3 shift = cell * glm::dvec3(0.123, 0.377, 0.231);  // poles on no grid line
  // The tilted plane's own axes, in which it is z = 0.
  const glm::dvec3 up = glm::normalize(glm::dvec3(0.31, 0.47, 1.0));
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), up));
  const glm::dvec3 ahead = glm::cross(up, right);
  SampledSurface surface;
  const auto add_crossing = [&](glm::dvec3 p) {
    if (shape == Shape::Plane) {
      const glm::dvec3 in_plane(glm::dot(p, right), glm::dot(p, ahead), 0.0);
      if (std::max(std::abs(in_plane.x), std::abs(in_plane.y)) > kPlaneHalf) return;
      return add(surface, {in_plane, {0, 0, 1}});
    }
    if (shape == Shape::Sphere) return add(surface, {p, glm::normalize(p)});
    const double ring = std::hypot(p.x, p.y);
    const glm::dvec3 on_ring(kMajor * p.x / ring, kMajor * p.y / ring, 0.0);
    add(surface, {p, glm::normalize(p - on_ring)});
  };
  for (int z = -half; z <= half; ++z) {
    for (int y = -half; y <= half; ++y) {
      for (int x = -half; x <= half; ++x) {
        const glm::dvec3 from = cell * glm::dvec3(x, y, z) + shift;
        const double at_from = inside(shape, from);
        if (std::abs(at_from) > cell) continue;
        for (int axis = 0; axis < 3; ++axis) {
          glm::dvec3 low = from;
          glm::dvec3 high = from;
          high[axis] += cell;
          if ((inside(shape, high) < 0.0) == (at_from < 0.0)) continue;
          for (int step = 0; step < 50; ++step) {
            const glm::dvec3 middle = (low + high) / 2.0;
            ((inside(shape, middle) < 0.0) == (at_from < 0.0) ? low : high) = middle;
          }
          add_crossing((low + high) / 2.0);
        }
      }
    }
  }
  return surface;
}

}  // namespace

std::string name_of(Shape shape) {
  return shape == Shape::Plane ? "plane" : shape == Shape::Sphere ? "sphere" : "torus";
}

std::string name_of(Sampling sampling) {
  switch (sampling) {
    case Sampling::Random:
      return "random";
    case Sampling::BlueNoise:
      return "blue noise";
    case Sampling::Jittered:
      return "jittered grid";
    case Sampling::Crossings:
      break;
  }
  return "grid crossings";
}

SampledSurface sample_surface(Shape shape, Sampling sampling, std::size_t points,
                              std::uint32_t seed) {
  std::mt19937 random(seed);
  switch (sampling) {
    case Sampling::BlueNoise:
      return throw_darts(shape, points, random);
    case Sampling::Jittered:
      return jitter_grid(shape, points, random);
    case Sampling::Crossings:
      return cross_grid(shape, points);
    case Sampling::Random:
      break;
  }
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  SampledSurface surface;
  for (std::size_t k = 0; k < points; ++k)
    add(surface, place_at(shape, uniform(random), uniform(random), kPlaneHalf));
  return surface;
}

SurfaceSamples surface_truth(Shape shape, std::size_t samples) {
  // Roberts' sequence, whose points are as even in two dimensions as in each.
  constexpr double kPlastic = 1.32471795724474602596;
  SurfaceSamples truth;
  for (std::size_t k = 0; k < samples; ++k) {
    const double a = std::fmod(0.5 + static_cast<double>(k) / kPlastic, 1.0);
    const double b = std::fmod(0.5 + static_cast<double>(k) / (kPlastic * kPlastic), 1.0);
    const Place place = place_at(shape, a, b, 1.0);
    truth.positions.push_back(place.position);
    truth.normals.push_back(place.normal);
  }
  return truth;
}

}  // namespace relief::test
