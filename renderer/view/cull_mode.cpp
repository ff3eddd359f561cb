#include "renderer/view/cull_mode.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "renderer/shading/materials.h"

namespace relief {
namespace {

/// What splats may reach beyond the samples: the widest disc of a splat has a radius of
/// sqrt(0.5) / 0.1 spacings where it is steepest.
constexpr double kReachSpacings = 8.0;

/// Whether a mode culls the faces of models that are known to be closed, and of no others.
bool of_closed_bodies(CullMode cull) {
  return cull == CullMode::Auto || cull == CullMode::Safe;
}

}  // namespace

bool sees_from_outside(const View& view, const Body& body) {
  const glm::dmat3 to_model = glm::transpose(body.where.rotation);
  const glm::dvec3 eye = to_model * (view.eye - body.where.translation) / body.where.scale;
  if (!view.orthographic) {
    return glm::any(glm::lessThan(eye, body.box.min)) ||
           glm::any(glm::greaterThan(eye, body.box.max));
  }
  const glm::dvec3 forward = to_model * (glm::transpose(view.rotation) * glm::dvec3(0, 0, -1));
  const glm::dvec3 middle = 0.5 * (body.box.min + body.box.max);
  const glm::dvec3 half = 0.5 * (body.box.max - body.box.min);
  return glm::dot(forward, middle - eye) > glm::dot(glm::abs(forward), half);
}

Bounds box_about(std::span<const Patch> patches) {
  Bounds box;
  double coarsest = 0.0;
  for (const Patch& patch : patches) coarsest = std::max(coarsest, patch.spacing);
  for_each_position(patches, [&box](const glm::dvec3& position) { extend(box, position); });
  if (box.empty()) return box;
  return {box.min - kReachSpacings * coarsest, box.max + kReachSpacings * coarsest};
}

bool has_closed_bodies(const PatchModel& model) {
  if (model.instances.empty()) return model.is_closed;
  return std::any_of(model.instances.begin(), model.instances.end(),
                     [](const Instance& instance) { return instance.is_closed; });
}

CullMode cull_mode_of(const RenderSettings& settings) {
  if (of_closed_bodies(settings.cull) && is_transparent(settings)) return CullMode::None;
  if (settings.cull == CullMode::Safe && settings.primitive != Primitive::Cell)
    return CullMode::None;
  return settings.cull;
}

bool may_hide_backs(const RenderSettings& settings, bool closed) {
  const CullMode cull = cull_mode_of(settings);
  return cull == CullMode::Back || (cull == CullMode::Auto && closed);
}

bool make_use_of_bodies(std::span<const View> views) {
  return std::any_of(views.begin(), views.end(),
                     [](const View& view) { return of_closed_bodies(view.cull); });
}

}  // namespace relief
