#include "common/volume/move.h"

#include <glm/gtc/quaternion.hpp>

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

}  // namespace

void move_volume(ScalarVolume& volume, const Transform& transform) {
  std::visit([&](auto& placement) { move(placement, transform); }, volume.placement);
}

Status move_gaussians(GaussianCloud& gaussians, const Transform& transform) {
  const bool turns = transform.rotation != glm::dmat3(1.0);
  if (turns && gaussians.degree > 0) {
    return make_error(
        "3D Gaussians whose colours depend on the direction can't be turned yet; leave the "
        "rotation "
        "out");
  }
  const auto turn = glm::quat(glm::quat_cast(transform.rotation));
  for (glm::vec3& centre : gaussians.centres)
    centre = glm::vec3(moved(transform, glm::dvec3(centre)));
  for (glm::vec3& scale : gaussians.scales) scale *= static_cast<float>(transform.scale);
  if (!turns) return {};
  for (glm::quat& rotation : gaussians.rotations) rotation = glm::normalize(turn * rotation);
  return {};
}

}  // namespace relief
