#include "renderer/engines/volume/sheet_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/volume/ray_space.h"

namespace relief::volume {
namespace {

/// Standard deviations that kernels are widened over: 1.2 % of a normal distribution lie beyond.
constexpr double kReachDeviations = 2.5;

/// Least variance of kernels in a sheet, nodes squared, without that of reading it.
constexpr double kLeastVariance = 0.3;

/// The share of a two-dimensional normal distribution's variance that is left if it is cut off at
/// that q.
double variance_kept(double cutoff) {
  const double beyond = std::exp(-0.5 * cutoff);
  return 1.0 - 0.5 * cutoff * beyond / (1.0 - beyond);
}

glm::dvec3 ordered(glm::dvec3 v, glm::ivec3 axes) {
  return {v[axes.x], v[axes.y], v[axes.z]};
}

}  // namespace

glm::ivec3 axes_of(const shared::VolumeGrid& rays) {
  const auto axis = [](glm::ivec4 unit) { return unit.x != 0 ? 0 : unit.y != 0 ? 1 : 2; };
  return {axis(rays.u), axis(rays.v), axis(rays.w)};
}

std::optional<shared::VolumeSheets> sheet_view(const VolumeFrame& frame, const RegularGrid& grid,
                                               const shared::VolumeGrid& rays,
                                               const SheetAtlas& atlas) {
  const View& view = frame.view;
  const RayCamera camera = ray_camera(view);
  const glm::ivec3 axes = axes_of(rays);
  const glm::dvec3 low(frame.box.low);
  const glm::dvec3 first = grid.origin + grid.step * low;
  const glm::dvec3 eye = ordered(glm::inverse(grid.step) * (view.eye - grid.origin) - low, axes);
  const glm::dvec3 ahead(camera.rotation[0].z, camera.rotation[1].z, camera.rotation[2].z);
  const auto step = [&](int axis) { return glm::vec4(glm::vec3(grid.step[axis]), 0.0F); };
  const glm::dvec3 by_axis(glm::dot(grid.step[axes.x], ahead), glm::dot(grid.step[axes.y], ahead),
                           glm::dot(grid.step[axes.z], ahead));

  // The widest kernel: at a corner of the box, where slopes and pixels are largest.
  const glm::dvec3 size(rays.u.w, rays.v.w, rays.w.w);
  double widest = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 at((corner & 1) != 0 ? size.x - 1.0 : 0.0,
                        (corner & 2) != 0 ? size.y - 1.0 : 0.0,
                        (corner & 4) != 0 ? size.z - 1.0 : 0.0);
    glm::dvec3 along(rays.along_origin);
    if (!view.orthographic) {
      const double depth = glm::dot(first - view.eye, ahead) + glm::dot(at, by_axis);
      if (!(depth > 0.0)) return std::nullopt;
      along = (at - eye) / depth;
    }
    const double from_middle = at.z - static_cast<double>(rays.place_origin.w);
    for (glm::length_t a = 0; a < 2; ++a) {
      const double slope = along[a] / along.z;
      const auto pixel = [&](glm::vec4 place, glm::vec4 change) {
        const glm::dvec3 p(place);
        const glm::dvec3 c(change);
        return (p[a] + from_middle * c[a] - at[a] * c.z) / along.z;
      };
      const double right = pixel(rays.place_x, rays.along_x);
      const double up = pixel(rays.place_y, rays.along_y);
      const double variance = static_cast<double>(rays.kernel.x) * (1.0 + slope * slope) +
                              static_cast<double>(rays.kernel.w) * (right * right + up * up);
      if (!std::isfinite(variance)) return std::nullopt;
      widest = std::max(widest, variance);
    }
  }
  const double kept = variance_kept(static_cast<double>(rays.kernel.y));
  if (kept * static_cast<double>(rays.kernel.x) - kReadVariance < kLeastVariance) return std::nullopt;
  const double reach =
      std::ceil(kReachDeviations * std::sqrt(std::max(kept * widest - kReadVariance, 0.0)));
  if (reach > kLargestReach) return std::nullopt;

  shared::VolumeSheets sheets{};
  sheets.eye = view.orthographic ? glm::vec4(glm::vec3(rays.along_origin), 1.0F)
                                 : glm::vec4(glm::vec3(eye), 0.0F);
  sheets.depth = glm::vec4(glm::dvec4(by_axis, glm::dot(first - view.eye, ahead)));
  sheets.from_eye = glm::vec4(glm::vec3(first - view.eye), 0.0F);
  sheets.step_u = step(axes.x);
  sheets.step_v = step(axes.y);
  sheets.step_w = step(axes.z);
  sheets.kernel = glm::vec4(glm::dvec4(kept, kReadVariance, reach, 0.0));
  sheets.texture = {atlas.texels, 0.0F, 0.0F};
  sheets.atlas = {atlas.columns, atlas.pitch, kSheetMargin};
  return sheets;
}

}  // namespace relief::volume
