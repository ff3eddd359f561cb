#include "renderer/engines/ewa/deferred_shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace relief::ewa {
namespace {

constexpr double kMaxLookups = 4.0;  // along each side of a pixel

/// Lookups along each side of a pixel: one per texel that the reflection moves by across it. It
/// turns twice as far as the normal; a texel is 2 / size of a face. (What is refracted turns less.)
int lookups_of(const Surface& surface, const Lighting& lighting) {
  const CubeMap* const cube = lit_material(lighting, surface.material).environment.cube;
  if (cube == nullptr) return 1;
  double change = 0.0;
  for (const glm::dvec3& c : surface.changes) change = std::max(change, glm::length(c));
  return static_cast<int>(std::clamp(std::ceil(change * cube->size), 1.0, kMaxLookups));
}

/// The normal beside a pixel's middle, linear between its neighbours'. Any length.
glm::dvec3 normal_beside(const Surface& surface, glm::dvec2 offset) {
  return surface.normal + std::abs(offset.x) * surface.changes[offset.x < 0.0 ? 0 : 1] +
         std::abs(offset.y) * surface.changes[offset.y < 0.0 ? 2 : 3];
}

}  // namespace

glm::dvec3 shade_surface(const Surface& surface, glm::dvec2 position, const View& view,
                         const Lighting& lighting) {
  const int side = lookups_of(surface, lighting);
  glm::dvec3 sum(0.0);
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const glm::dvec2 offset = (glm::dvec2(i, j) + 0.5) / static_cast<double>(side) - 0.5;
      const glm::dvec2 at = position + offset;
      const glm::dvec2 window(at.x, view.height - at.y);
      const glm::dvec3 through = ray_through(view, window);
      const glm::dvec3 ray = glm::normalize(through);
      const glm::dvec3 turned = normal_beside(surface, offset);
      const double length = glm::length(turned);
      const glm::dvec3 normal = length > 0.0 ? turned / length : -ray;
      SeenSurface seen{glm::vec3(surface.albedo), glm::vec3(normal), glm::vec3(ray),
                       glm::vec3(ray_start(view, window) + surface.depth * through)};
      seen.from_behind = surface.from_behind;
      sum += glm::dvec3(shade(lighting, surface.material, seen));
    }
  }
  return sum / static_cast<double>(side * side);
}

}  // namespace relief::ewa
