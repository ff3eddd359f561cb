#include "renderer/engines/volume/grid_rays.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/matrix.hpp>

#include "renderer/volume/splats/footprint.h"
#include "renderer/volume/splats/ray_space.h"
#include "renderer/volume/splats/splat_order.h"

namespace relief::volume {
namespace {

/// Steps along a sheet from one sheet to the next: beyond it a pixel gathers hundreds of nodes.
constexpr double kSteepest = 16.0;

/// Nodes from the eye to the nearest kernel: before it the Jacobian differs too much between a
/// kernel's centre and its rim (measured with the eye inside: 21 dB to volume-reference).
constexpr double kNearest = 8.0;

/// A linear function of the pixel: at the image's middle, and its change to the right and upward.
struct Linear {
  glm::dvec3 middle;
  glm::dvec3 x;
  glm::dvec3 y;

  [[nodiscard]] glm::dvec3 at(glm::dvec2 pixel) const { return middle + pixel.x * x + pixel.y * y; }
};

/// The world's axes in camera space, as columns from camera to index space; u, v and w last.
glm::dmat3 to_sheets(const RayCamera& camera, const RegularGrid& grid,
                     const std::array<glm::length_t, 3>& axes) {
  const glm::dmat3 to_index = glm::inverse(grid.step) * glm::transpose(camera.rotation);
  glm::dmat3 ordered(0.0);
  for (glm::length_t column = 0; column < 3; ++column) {
    for (glm::length_t row = 0; row < 3; ++row)
      ordered[column][row] = to_index[column][axes[static_cast<std::size_t>(row)]];
  }
  return ordered;
}

double filter_variance(VolumeFilter filter) {
  if (filter == VolumeFilter::Ewa) return kLowPassVariance;
  return filter == VolumeFilter::Dilated ? kDilation : 0.0;
}

}  // namespace

NodeBox box_of(const KernelCloud& cloud) {
  NodeBox box{cloud.size, glm::uvec3(0)};
  for (std::size_t k = 0; k < cloud.nodes.size(); ++k) {
    const glm::uvec3 at = cloud.node(k);
    box.low = glm::min(box.low, at);
    box.high = glm::max(box.high, at);
  }
  return box;
}

std::optional<shared::VolumeGrid> grid_rays(const VolumeFrame& frame, const RegularGrid& grid) {
  const View& view = frame.view;
  const RayCamera camera = ray_camera(view);
  const glm::length_t axis = sheet_axis(frame.cloud, camera);
  const std::array<glm::length_t, 3> axes{(axis + 1) % 3, (axis + 2) % 3, axis};
  const glm::dmat3 sheets = to_sheets(camera, grid, axes);
  const glm::dvec3 node =
      glm::inverse(grid.step) * (view.eye - grid.origin) - glm::dvec3(frame.box.low);
  const glm::dvec3 eye(node[axes[0]], node[axes[1]], node[axes[2]]);
  const glm::uvec3 size = frame.box.size();
  const double middle = 0.5 * (size[axis] - 1U);
  const glm::dvec3 outside = glm::max(-node, node - glm::dvec3(size - 1U));
  if (!view.orthographic && std::max({outside.x, outside.y, outside.z}) < kNearest)
    return std::nullopt;

  // Camera space: a ray is at (pixel - axis) / scale at depth 1, or there at any depth.
  const glm::dvec2 off = camera.middle - 0.5 * glm::dvec2(view.width, view.height);
  const glm::dvec3 right(1.0 / camera.scale.x, 0.0, 0.0);
  const glm::dvec3 up(0.0, 1.0 / camera.scale.y, 0.0);
  const glm::dvec3 ahead(0.0, 0.0, 1.0);
  const Linear spot{sheets * (-off.x * right - off.y * up), sheets * right, sheets * up};
  Linear along;
  Linear place;
  if (view.orthographic) {
    along = {sheets * ahead, glm::dvec3(0.0), glm::dvec3(0.0)};
    const glm::dvec3 a = along.middle;
    const auto on_middle = [&](glm::dvec3 p, double w) {
      return glm::dvec3(p.x * a.z + (w - p.z) * a.x, p.y * a.z + (w - p.z) * a.y, w - p.z);
    };
    place = {on_middle(eye + spot.middle, middle), on_middle(spot.x, 0.0), on_middle(spot.y, 0.0)};
  } else {
    along = {sheets * ahead + spot.middle, spot.x, spot.y};
    const double w = middle - eye.z;
    const auto on_middle = [&](glm::dvec3 a, double depth) {
      return glm::dvec3(eye.x * a.z + w * a.x, eye.y * a.z + w * a.y, depth);
    };
    place = {on_middle(along.middle, w), on_middle(along.x, 0.0), on_middle(along.y, 0.0)};
  }
  const glm::dvec2 half(0.5 * view.width, 0.5 * view.height);
  for (const glm::dvec2 corner : {glm::dvec2(-1, -1), {1, -1}, {-1, 1}, {1, 1}}) {
    const glm::dvec3 a = along.at(corner * half);
    if (!(a.z * along.middle.z > 0.0)) return std::nullopt;
    if (std::max(std::abs(a.x), std::abs(a.y)) > kSteepest * std::abs(a.z)) return std::nullopt;
  }

  const FootprintRule& rule = frame.footprints.front();
  const double sigma = frame.settings.volume.kernel_sigma;
  const double near =
      view.orthographic ? 0.0 : std::sqrt(to_camera(camera, frame.cloud.variances.front()).zz);
  const auto unit = [&](std::size_t a) {
    glm::ivec3 step(0);
    step[axes[a]] = 1;
    return glm::ivec4(step, static_cast<int>(size[axes[a]]));
  };
  shared::VolumeGrid rays{};
  rays.place_origin = glm::vec4(place.middle, middle);
  rays.place_x = glm::vec4(place.x, 0.0);
  rays.place_y = glm::vec4(place.y, 0.0);
  rays.along_origin = glm::vec4(along.middle, view.orthographic ? 1.0 : 0.0);
  rays.along_x = glm::vec4(along.x, off.x);
  rays.along_y = glm::vec4(along.y, off.y);
  rays.kernel = {sigma * sigma, rule.cutoff, near, filter_variance(rule.filter)};
  rays.camera = {camera.scale.x, camera.scale.y,
                 rule.filter == VolumeFilter::UniformScaling ? 1.0 : 0.0, 0.0};
  rays.u = unit(0);
  rays.v = unit(1);
  rays.w = unit(2);
  return rays;
}

}  // namespace relief::volume
