#include "renderer/volume/kernels/volume_nodes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <glm/matrix.hpp>

namespace relief {
namespace {

/// The neighbours of an index, as far as there are any.
struct Neighbours {
  std::uint32_t before;
  std::uint32_t after;
  [[nodiscard]] double distance() const { return static_cast<double>(after - before); }
};

Neighbours neighbours_of(std::uint32_t at, std::uint32_t size) {
  return {at > 0 ? at - 1 : at, at + 1 < size ? at + 1 : at};
}

}  // namespace

VolumeNodes::VolumeNodes(const ScalarVolume& volume) : volume_(&volume) {
  assert(!std::holds_alternative<ScatteredPoints>(volume.placement) && "a volume with a grid");
  if (const auto* const grid = std::get_if<RegularGrid>(&volume.placement))
    inverse_step_ = glm::inverse(grid->step);
}

bool VolumeNodes::is_regular() const {
  return std::holds_alternative<RegularGrid>(volume_->placement);
}

glm::dvec3 VolumeNodes::position(glm::uvec3 node) const {
  if (const auto* const grid = std::get_if<RegularGrid>(&volume_->placement))
    return grid->origin + grid->step * glm::dvec3(node);
  if (const auto* const grid = std::get_if<RectilinearGrid>(&volume_->placement)) {
    const auto& c = grid->coordinates;
    return grid->origin + grid->axes * glm::dvec3(c[0][node.x], c[1][node.y], c[2][node.z]);
  }
  return std::get<CurvilinearGrid>(volume_->placement).positions[index(node)];
}

glm::dmat3 VolumeNodes::step(glm::uvec3 node) const {
  if (const auto* const grid = std::get_if<RegularGrid>(&volume_->placement)) return grid->step;
  glm::dmat3 steps(0.0);
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    const Neighbours beside = neighbours_of(node[axis], volume_->size[axis]);
    glm::uvec3 before = node;
    glm::uvec3 after = node;
    before[axis] = beside.before;
    after[axis] = beside.after;
    if (beside.distance() > 0.0)
      steps[axis] = (position(after) - position(before)) / beside.distance();
  }
  // A grid of one layer is as thick as its cells are wide.
  for (glm::length_t axis = 0; axis < 3; ++axis) {
    if (volume_->size[axis] > 1) continue;
    const glm::dvec3& u = steps[(axis + 1) % 3];
    const glm::dvec3& v = steps[(axis + 2) % 3];
    const glm::dvec3 across = glm::cross(u, v);
    const double area = glm::length(across);
    if (area > 0.0) steps[axis] = across / std::sqrt(area);
  }
  return steps;
}

glm::dvec3 VolumeNodes::gradient(glm::uvec3 node) const {
  const auto change = [&](glm::length_t axis) {
    const double own = value(node);
    const Neighbours beside = neighbours_of(node[axis], volume_->size[axis]);
    glm::uvec3 at = node;
    at[axis] = beside.before;
    double before = value(at);
    at[axis] = beside.after;
    double after = value(at);
    double distance = beside.distance();
    if (std::isnan(before)) {
      before = own;
      distance -= 1.0;
    }
    if (std::isnan(after)) {
      after = own;
      distance -= 1.0;
    }
    return distance > 0.0 ? (after - before) / distance : 0.0;
  };
  const glm::dvec3 by_index(change(0), change(1), change(2));
  const glm::dmat3 inverse = is_regular() ? inverse_step_ : glm::inverse(step(node));
  return glm::transpose(inverse) * by_index;
}

}  // namespace relief
