#include "renderer/engines/raytrace/glass_path.h"

#include <glm/exponential.hpp>

#include "renderer/engines/raytrace/surface.h"
#include "shaders/include/shading.h"

namespace relief::raytrace {
namespace {

/// What is left of the light when nothing more is followed: a sixteenth of a step of 8 bits.
constexpr float kMinShare = 2.5e-4F;

}  // namespace

glm::vec3 light_through(const GlassBody& body, SightRay ray) {
  const auto seen = [&body](glm::dvec3 direction) { return look_up(body.environment, direction); };
  glm::vec3 light(0.0F);
  glm::vec3 share(1.0F);  // of what comes along the ray
  for (int reflections = 0; reflections <= kMaxReflections; ++reflections) {
    const std::optional<Hit> at = body.scene->find_leaving(ray);
    if (!at) break;
    share *= glm::exp(static_cast<float>(-at->depth / body.diameter) * body.constants.absorption);
    const shared::SplitRay split = shared::split_within(
        normal_at(*body.mesh, *at), glm::vec3(ray.direction), body.constants.ior);
    light += (1.0F - split.reflectance) * share * seen(glm::dvec3(split.refracted));
    share *= split.reflectance;
    ray = {ray.start + at->depth * ray.direction, glm::dvec3(split.reflected)};
    if (glm::max(share.x, glm::max(share.y, share.z)) < kMinShare) break;
  }
  return light + share * seen(ray.direction);
}

}  // namespace relief::raytrace
