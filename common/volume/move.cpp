#include "common/volume/move.h"

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <span>

#include "common/volume/harmonics_turn.h"

namespace relief {
namespace {

void move(RegularGrid& grid, const Transform& transform) {
  grid.origin = moved(transform, grid.origin);
  grid.step = transform.scale * transform.rotation * grid.step;
}

void move(RectilinearGrid& grid, const Transform& transform) {
  grid.origin = moved(transform, grid.origin);
  grid.axes = transform.rotation * grid.axes;
  for (auto& coordinates : grid.coordinates) {
    for (double& c : coordinates) c *= transform.scale;
  }
}

void move(CurvilinearGrid& grid, const Transform& transform) {
  for (glm::dvec3& position : grid.positions) position = moved(transform, position);
}

void move(ScatteredPoints& points, const Transform& transform) {
  for (glm::dvec3& position : points.positions) position = moved(transform, position);
  for (float& spacing : points.spacings) spacing *= static_cast<float>(transform.scale);
  for (float& width : points.widths) width *= static_cast<float>(transform.scale);
  for (glm::vec3& gradient : points.gradients)
    gradient = glm::vec3(transform.rotation * glm::dvec3(gradient) / transform.scale);
}

constexpr glm::vec3 kNothing{0.0F};

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

}  // namespace

void move_volume(ScalarVolume& volume, const Transform& transform) {
  std::visit([&](auto& placement) { move(placement, transform); }, volume.placement);
}

Status move_gaussians(GaussianCloud& gaussians, const Transform& transform) {
  const auto scale = static_cast<float>(transform.scale);
  for (std::size_t k = 0; k < gaussians.size(); ++k) {
    glm::vec3& centre = gaussians.centres[k];
    glm::vec3& scales = gaussians.scales[k];
    centre = glm::vec3(moved(transform, glm::dvec3(centre)));
    scales *= scale;
    if (!is_finite(centre) || !is_finite(scales) || !glm::all(glm::greaterThan(scales, kNothing))) {
      return make_error(
          "Gaussian {} leaves the range of single precision; move and scale the scene less", k + 1);
    }
  }
  if (transform.rotation == glm::dmat3(1.0)) return {};
  // A Gaussian is its own mirror image in its centre: what a mirror does to it, the rotation that
  // is the mirror's negative does, too.
  const bool is_mirror = glm::determinant(transform.rotation) < 0.0;
  const glm::dquat turn = glm::quat_cast(is_mirror ? -transform.rotation : transform.rotation);
  for (glm::quat& rotation : gaussians.rotations)
    rotation = glm::quat(glm::normalize(turn * glm::dquat(rotation)));
  if (gaussians.degree == 0) return {};
  const HarmonicsTurn harmonics(transform.rotation, gaussians.degree);
  const std::size_t count = harmonics_of(gaussians.degree);
  for (std::size_t k = 0; k < gaussians.size(); ++k)
    harmonics.apply(std::span(gaussians.harmonics).subspan(k * count, count));
  return {};
}

}  // namespace relief
