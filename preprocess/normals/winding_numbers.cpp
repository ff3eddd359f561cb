#include "preprocess/normals/winding_numbers.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace relief {
namespace {

// A piece farther than two of its radii is a dipole, as in [Barill 2018].
constexpr float kFarRadii = 2.0F;
constexpr float kPi = std::numbers::pi_v<float>;

struct Dipole {
  glm::vec3 centre{0.0F};
  glm::vec3 area_normal{0.0F};
  float squared_reach = 0.0F;  ///< beyond it, the dipole stands for its piece
};

Dipole dipole_of(const PiecedSurface& surface, std::size_t piece) {
  Dipole dipole;
  float area = 0.0F;
  const std::uint32_t begin = surface.first[piece];
  const std::uint32_t end = surface.first[piece + 1];
  for (std::uint32_t i = begin; i < end; ++i) {
    const float element = glm::length(surface.area_normals[i]);
    dipole.centre += element * surface.positions[i];
    dipole.area_normal += surface.area_normals[i];
    area += element;
  }
  dipole.centre /= std::max(area, std::numeric_limits<float>::min());
  float squared_radius = 0.0F;
  for (std::uint32_t i = begin; i < end; ++i) {
    const glm::vec3 off = surface.positions[i] - dipole.centre;
    squared_radius = std::max(squared_radius, glm::dot(off, off));
  }
  dipole.squared_reach = kFarRadii * kFarRadii * squared_radius;
  return dipole;
}

/// The solid angle of an element, smoothed as for a disc of this squared radius, so that points do
/// not see a pole in a neighbour that noise has put before them.
float solid_angle(glm::vec3 to, glm::vec3 area_normal, float squared_radius) {
  const float squared = glm::dot(to, to) + squared_radius + std::numeric_limits<float>::min();
  return glm::dot(to, area_normal) / (squared * std::sqrt(squared));
}

float solid_angle_of_points(const PiecedSurface& surface, std::size_t piece, glm::vec3 from) {
  float sum = 0.0F;
  for (std::uint32_t i = surface.first[piece]; i < surface.first[piece + 1]; ++i) {
    const glm::vec3 element = surface.area_normals[i];
    sum += solid_angle(surface.positions[i] - from, element, glm::length(element) / kPi);
  }
  return sum;
}

}  // namespace

std::vector<float> areas_of(const PiecedSurface& surface) {
  std::vector<float> areas(surface.count(), 0.0F);
  for (std::size_t piece = 0; piece < areas.size(); ++piece) {
    for (std::uint32_t i = surface.first[piece]; i < surface.first[piece + 1]; ++i)
      areas[piece] += glm::length(surface.area_normals[i]);
  }
  return areas;
}

SurfacePlaces places_on(const PiecedSurface& surface, std::size_t per_piece) {
  const std::vector<float> areas = areas_of(surface);
  SurfacePlaces places;
  for (std::size_t piece = 0; piece < areas.size(); ++piece) {
    const std::size_t count = surface.first[piece + 1] - surface.first[piece];
    const std::size_t taken = std::min(per_piece, count);
    for (std::size_t n = 0; n < taken; ++n) {
      const std::size_t i = surface.first[piece] + (2 * n + 1) * count / (2 * taken);
      places.positions.push_back(surface.positions[i]);
      places.areas.push_back(areas[piece] / static_cast<float>(taken));
    }
  }
  return places;
}

Eigen::MatrixXf winding_numbers(const PiecedSurface& surface, const SurfacePlaces& places) {
  Eigen::MatrixXf numbers(static_cast<Eigen::Index>(places.positions.size()),
                          static_cast<Eigen::Index>(surface.count()));
  tbb::parallel_for(std::size_t{0}, surface.count(), [&](std::size_t piece) {
    const Dipole dipole = dipole_of(surface, piece);
    for (std::size_t p = 0; p < places.positions.size(); ++p) {
      const glm::vec3 to = dipole.centre - places.positions[p];
      const float angle = glm::dot(to, to) > dipole.squared_reach
                              ? solid_angle(to, dipole.area_normal, 0.0F)
                              : solid_angle_of_points(surface, piece, places.positions[p]);
      numbers(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(piece)) =
          angle / (4.0F * kPi);
    }
  });
  return numbers;
}

}  // namespace relief
