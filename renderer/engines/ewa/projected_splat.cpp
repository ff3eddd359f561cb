#include "renderer/engines/ewa/projected_splat.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <type_traits>

namespace relief::ewa {
namespace {

/// Depths are of one surface if they differ by less than this many radii, plus this many times what
/// the tangent plane's depth changes by from one pixel to the next (measured: docs/decisions/0074).
constexpr double kThresholdRadii = 1.0;
constexpr double kThresholdSteps = 1.0;

/// See project_splat. Kernels end at sqrt(2 cutoff) radii, 6.3 for the largest cutoff, in a plane
/// that leans as it likes.
constexpr double kEdgeRadii = 8.0;

/// In the camera frame of resampling_filter.h.
glm::dvec3 to_camera(const View& view, glm::dvec3 world) {
  const glm::dvec3 eye = view.rotation * world;
  return {eye.x, -eye.y, -eye.z};
}

bool in_frustum(const SplatCamera& camera, glm::dvec3 p, double radius) {
  const double reach = std::sqrt(2.0 * camera.cutoff);
  if (camera.view.orthographic) {
    const double wide = reach * radius + (reach + 1.0) / camera.mapping.scale;
    return std::abs(p.x) - camera.view.slope_x <= wide &&
           std::abs(p.y) - camera.view.slope_y <= wide;
  }
  const double wide = reach * radius + (reach + 1.0) * p.z / camera.mapping.scale;
  const auto inside = [&](double across, double slope) {
    return std::abs(across) - p.z * slope <= wide * std::sqrt(1.0 + slope * slope);
  };
  return inside(p.x, camera.view.slope_x) && inside(p.y, camera.view.slope_y);
}

template <class Kernel>
std::optional<Kernel> make_kernel(const SplatCamera& camera, const TangentMapping& plane,
                                  double radius) {
  if constexpr (std::is_same_v<Kernel, SourceKernel>) {
    return source_kernel(plane, radius, camera.cutoff);
  } else {
    return screen_kernel(plane, radius, camera.filter, camera.cutoff);
  }
}

/// The depth of the plane through `p` across `n` (unit), of a splat of radius h.
TangentDepth tangent_depth(const PixelMapping& mapping, glm::dvec3 p, glm::dvec3 n, double h) {
  TangentDepth depth;
  if (mapping.orthographic) {
    depth.inverse = false;
    depth.middle = p.z;
    depth.change = -glm::dvec2(n) / (mapping.scale * n.z);
    depth.least = p.z - kEdgeRadii * h;
    depth.most = p.z + kEdgeRadii * h;
    depth.threshold = kThresholdRadii * h + kThresholdSteps * glm::length(depth.change);
    return depth;
  }
  depth.middle = 1.0 / p.z;
  depth.change = glm::dvec2(n) / (mapping.scale * glm::dot(n, p));
  depth.least = 0.5 * depth.middle;
  depth.most = 2.0 * depth.middle;
  const double step = p.z * p.z * glm::length(depth.change);
  depth.threshold = kThresholdRadii * h + kThresholdSteps * step;
  return depth;
}

/// Returns the part of a splat's radius (position p and unit normal n relative to the camera) that
/// does not reach behind the plane through the eye, where it would have no image. One that faces
/// the eye keeps all of it, however near.
double seen_radius(const SplatCamera& camera, glm::dvec3 p, glm::dvec3 n, double radius) {
  const double toward = radius * std::sqrt(std::max(1.0 - n.z * n.z, 0.0));
  return camera.view.orthographic || toward <= p.z ? radius : radius * (p.z / toward);
}

}  // namespace

SplatCamera make_splat_camera(const View& view, const EwaSettings& settings) {
  return {
      view,
      {0.5 * view.height / view.slope_y, {0.5 * view.width, 0.5 * view.height}, view.orthographic},
      settings.filter,
      settings.cutoff};
}

template <class Kernel>
PixelBox pixels_of(const Kernel& kernel, const PixelBox& limits) {
  const auto first = [](double low, std::int64_t limit) {
    return static_cast<std::int64_t>(std::ceil(std::max(low - 0.5, static_cast<double>(limit))));
  };
  const auto last = [](double high, std::int64_t limit) {
    return static_cast<std::int64_t>(std::floor(std::min(high - 0.5, static_cast<double>(limit))));
  };
  const glm::dvec2 low = kernel.centre - kernel.extent;
  const glm::dvec2 high = kernel.centre + kernel.extent;
  if (low.x > static_cast<double>(limits.right) + 1.0 || high.x < 0.0 ||
      low.y > static_cast<double>(limits.bottom) + 1.0 || high.y < 0.0)
    return {};
  return {first(low.x, limits.left), last(high.x, limits.right), first(low.y, limits.top),
          last(high.y, limits.bottom)};
}

template <class Kernel>
std::optional<ProjectedSplat<Kernel>> project_splat(const SplatCamera& camera, glm::dvec3 position,
                                                    glm::dvec3 normal, double radius) {
  const glm::dvec3 p = to_camera(camera.view, position - camera.view.eye);
  if (!(p.z > 0.0 && p.z >= camera.view.near) || !(radius > 0.0)) return std::nullopt;
  const double length = glm::length(normal);
  if (!(length > 0.0 && std::isfinite(length))) return std::nullopt;
  const glm::dvec3 n = to_camera(camera.view, normal / length);
  const double h = seen_radius(camera, p, n, radius);
  if (!in_frustum(camera, p, h)) return std::nullopt;
  const auto plane = map_tangent_plane(camera.mapping, p, n);
  if (!plane) return std::nullopt;
  const auto kernel = make_kernel<Kernel>(camera, *plane, h);
  if (!kernel) return std::nullopt;
  return ProjectedSplat<Kernel>{*kernel, tangent_depth(camera.mapping, p, n, h), 0, 0, 0};
}

void project_clip_lines(const SplatCamera& camera, glm::dvec3 position, glm::dvec3 normal,
                        double radius, std::span<const ClipLine> lines,
                        std::vector<ImageLine>& projected) {
  const glm::dvec3 p = to_camera(camera.view, position - camera.view.eye);
  const glm::dvec3 n = to_camera(camera.view, glm::normalize(normal));
  const auto plane = map_tangent_plane(camera.mapping, p, n);
  if (!plane) return;
  const double h = seen_radius(camera, p, n, radius);
  const SeenSplat seen = seen_splat(*plane, h, camera.filter);
  for (const ClipLine& line : lines) {
    const glm::dvec3 direction = to_camera(camera.view, glm::dvec3(line.direction));
    projected.push_back(image_line(beyond_line(camera.mapping, p, n, direction, line.offset), seen,
                                   line.ends_group));
  }
}

template PixelBox pixels_of(const ScreenKernel&, const PixelBox&);
template PixelBox pixels_of(const SourceKernel&, const PixelBox&);
template std::optional<ProjectedSplat<ScreenKernel>> project_splat(const SplatCamera&, glm::dvec3,
                                                                   glm::dvec3, double);
template std::optional<ProjectedSplat<SourceKernel>> project_splat(const SplatCamera&, glm::dvec3,
                                                                   glm::dvec3, double);

}  // namespace relief::ewa
