#include "renderer/view/uniforms.h"

#include <glm/matrix.hpp>

#include "renderer/shading/lighting.h"

namespace relief {

shared::PatchView view_patch(const View& view, const StoredPatch& patch) {
  const glm::dmat3 turn = view.rotation * patch.axes * patch.spacing;
  const glm::dvec3 origin = view.rotation * (patch.origin - view.eye);
  const glm::dmat4 eye_from_grid(glm::dvec4(turn[0], 0.0), glm::dvec4(turn[1], 0.0),
                                 glm::dvec4(turn[2], 0.0), glm::dvec4(origin, 1.0));
  shared::PatchView seen{};
  seen.clip_from_grid = glm::mat4(view.projection * eye_from_grid);
  if (view.orthographic) {
    const glm::dvec3 forward = glm::transpose(view.rotation) * glm::dvec3(0.0, 0.0, -1.0);
    seen.eye = glm::vec4(glm::dvec4(glm::transpose(patch.axes) * forward, -origin.z));
    return seen;
  }
  const glm::dvec3 eye = glm::transpose(patch.axes) * (view.eye - patch.origin) / patch.spacing;
  seen.eye = glm::vec4(glm::vec3(eye), 0.0F);
  return seen;
}

shared::Frame make_frame(const View& view, double largest_sprite, const Lights& lights) {
  const glm::dmat3 to_world = glm::transpose(view.rotation);
  const double pixel_x = 2.0 * view.slope_x / view.width;
  const double pixel_y = 2.0 * view.slope_y / view.height;
  const auto direction = [&to_world](double x, double y, double z, double w) {
    return glm::vec4(glm::dvec4(to_world * glm::dvec3(x, y, z), w));
  };
  shared::Frame frame{};
  frame.ray_origin = direction(view.middle.x - view.slope_x, view.middle.y - view.slope_y,
                               view.orthographic ? 0.0 : -1.0, view.near);
  if (view.orthographic) frame.ray_along = direction(0.0, 0.0, -1.0, view.far - view.near);
  frame.ray_x = direction(pixel_x, 0.0, 0.0, 1.0 / pixel_x);
  frame.ray_y = direction(0.0, pixel_y, 0.0, largest_sprite);
  frame.viewport = {view.width, view.height, 1.0F / static_cast<float>(view.width),
                    1.0F / static_cast<float>(view.height)};
  set_lights(frame, view, lights);
  return frame;
}

}  // namespace relief
