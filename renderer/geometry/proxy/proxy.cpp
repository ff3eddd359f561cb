#include "renderer/geometry/proxy/proxy.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief {
namespace {

/// Where the model has no finer ones, vertices may be this many times as far apart.
constexpr double kMaxProxyPixels = 2.0;
/// The coarsest level has this many cubes across.
constexpr double kFewestAcross = 3.0;

}  // namespace

Sphere sphere_about(std::span<const Patch> patches) {
  Bounds box;
  for_each_position(patches, [&box](glm::dvec3 p) { extend(box, p); });
  if (box.empty()) return {};
  Sphere sphere{0.5 * (box.min + box.max), 0.0};
  for_each_position(patches, [&sphere](glm::dvec3 p) {
    sphere.radius = std::max(sphere.radius, glm::distance(sphere.centre, p));
  });
  return sphere;
}

std::vector<double> proxy_spacings(const Sphere& model, double spacing, double diameter) {
  const double across = 2.0 * model.radius;
  std::vector<double> spacings;
  for (double s = 2.0 / diameter * across; s * kFewestAcross < across; s *= std::sqrt(2.0)) {
    if (s >= 2.0 * spacing) spacings.push_back(s);
  }
  return spacings;
}

Proxy moved(const Transform& transform, const Proxy& model) {
  Proxy placed{{moved(transform, model.sphere.centre), transform.scale * model.sphere.radius},
               model.pixels,
               model.spacings,
               model.diameter};
  for (double& spacing : placed.spacings) spacing *= transform.scale;
  return placed;
}

bool is_proxy(const View& view, const Proxy& model) {
  if (model.spacings.empty()) return false;
  const double pixel = nearest_pixel(view, model.sphere.centre, model.sphere.radius);
  // Where a pixel has several samples, View::proxy_diameter counts these.
  const double samples = view.proxy_diameter / kProxyDiameter;
  const double most_pixels = 0.5 * model.pixels * model.diameter;
  return 2.0 * model.sphere.radius < samples * most_pixels * pixel &&
         model.spacings.front() <= samples * kMaxProxyPixels * model.pixels * pixel;
}

std::size_t choose_proxy_level(const View& view, const Proxy& model) {
  const double most = model.pixels * nearest_pixel(view, model.sphere.centre, model.sphere.radius);
  std::size_t level = 0;
  while (level + 1 < model.spacings.size() && model.spacings[level + 1] <= most) ++level;
  return level;
}

}  // namespace relief
