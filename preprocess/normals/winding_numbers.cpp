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

PieceDipole dipole_of(const PiecedSurface& surface, std::size_t piece) {
  PieceDipole dipole;
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

float winding_number(const PiecedSurface& surface, std::size_t piece, const PieceDipole& dipole,
                     glm::vec3 place) {
  const glm::vec3 to = dipole.centre - place;
  const float angle = glm::dot(to, to) > dipole.squared_reach
                          ? solid_angle(to, dipole.area_normal, 0.0F)
                          : solid_angle_of_points(surface, piece, place);
  return angle / (4.0F * kPi);
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

std::vector<PieceDipole> dipoles_of(const PiecedSurface& surface) {
  std::vector<PieceDipole> dipoles;
  for (std::size_t piece = 0; piece < surface.count(); ++piece)
    dipoles.push_back(dipole_of(surface, piece));
  return dipoles;
}

Eigen::MatrixXf winding_numbers(const PiecedSurface& surface, const SurfacePlaces& places) {
  const auto count = static_cast<Eigen::Index>(places.positions.size());
  Eigen::MatrixXf numbers(count, static_cast<Eigen::Index>(surface.count()));
  tbb::parallel_for(std::size_t{0}, surface.count(), [&](std::size_t piece) {
    const PieceDipole dipole = dipole_of(surface, piece);
    for (Eigen::Index p = 0; p < count; ++p) {
      numbers(p, static_cast<Eigen::Index>(piece)) =
          winding_number(surface, piece, dipole, places.positions[static_cast<std::size_t>(p)]);
    }
  });
  return numbers;
}

Eigen::VectorXf total_winding_numbers(const PiecedSurface& surface,
                                      const std::vector<PieceDipole>& dipoles,
                                      const Eigen::VectorXf& sides, const SurfacePlaces& places) {
  Eigen::VectorXf totals(static_cast<Eigen::Index>(places.positions.size()));
  tbb::parallel_for(Eigen::Index{0}, totals.size(), [&](Eigen::Index p) {
    const glm::vec3 place = places.positions[static_cast<std::size_t>(p)];
    float total = 0.0F;
    for (std::size_t piece = 0; piece < dipoles.size(); ++piece) {
      const float side = sides[static_cast<Eigen::Index>(piece)];
      if (side != 0.0F) total += side * winding_number(surface, piece, dipoles[piece], place);
    }
    totals[p] = total;
  });
  return totals;
}

}  // namespace relief
