#include "renderer/view.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/trigonometric.hpp>

#include "renderer/patch_store.h"

namespace relief {
namespace {

/// A light in eye coordinates.
struct Light {
  glm::dvec3 direction;  ///< toward the light, any length
  glm::vec3 colour;      ///< linear; what a white surface facing it sends back
};

/// Key from the upper left, fill from the right, rim from behind and above. Together with the
/// ambient light a white surface facing the eye comes out just below 1.
const std::array<Light, shared::kLights> kCameraLights{
    Light{{-0.5, 0.7, 0.9}, {0.80F, 0.78F, 0.74F}}, Light{{0.9, 0.1, 0.6}, {0.24F, 0.26F, 0.30F}},
    Light{{0.1, 0.8, -0.6}, {0.35F, 0.35F, 0.38F}}};
constexpr float kAmbient = 0.06F;

}  // namespace

View make_view(const Camera& camera, std::uint32_t width, std::uint32_t height, double near) {
  const double aspect = static_cast<double>(width) / height;
  View view;
  view.eye = camera.eye;
  view.rotation = view_rotation(camera);
  view.projection =
      glm::dmat4(reversed_infinite_projection(camera.vertical_fov_degrees, aspect, near));
  view.near = near;
  view.slope_y = std::tan(glm::radians(camera.vertical_fov_degrees) / 2.0);
  view.slope_x = view.slope_y * aspect;
  view.width = width;
  view.height = height;
  return view;
}

glm::dvec3 ray_through(const View& view, glm::dvec2 window) {
  const glm::dvec2 ndc = 2.0 * window / glm::dvec2(view.width, view.height) - 1.0;
  return glm::transpose(view.rotation) *
         glm::dvec3(ndc.x * view.slope_x, ndc.y * view.slope_y, -1.0);
}

shared::PatchView view_patch(const View& view, const StoredPatch& patch) {
  const glm::dmat3 turn = view.rotation * patch.axes * patch.spacing;
  const glm::dvec3 origin = view.rotation * (patch.origin - view.eye);
  const glm::dmat4 eye_from_grid(glm::dvec4(turn[0], 0.0), glm::dvec4(turn[1], 0.0),
                                 glm::dvec4(turn[2], 0.0), glm::dvec4(origin, 1.0));
  shared::PatchView seen{};
  seen.clip_from_grid = glm::mat4(view.projection * eye_from_grid);
  const glm::dvec3 eye = glm::transpose(patch.axes) * (view.eye - patch.origin) / patch.spacing;
  seen.eye = glm::vec4(glm::vec3(eye), 0.0F);
  return seen;
}

bool sees_sphere(const View& view, glm::dvec3 centre, double radius) {
  const glm::dvec3 c = view.rotation * (centre - view.eye);
  const double depth = -c.z;
  if (depth < -radius) return false;
  // Distance to a side plane through the eye; its inward normal is (-1, 0, -slope) normalised.
  const auto outside = [depth, radius](double across, double slope) {
    return std::abs(across) - depth * slope > radius * std::sqrt(1.0 + slope * slope);
  };
  return !outside(c.x, view.slope_x) && !outside(c.y, view.slope_y);
}

shared::Frame make_frame(const View& view, double largest_sprite) {
  const glm::dmat3 to_world = glm::transpose(view.rotation);
  const double pixel_x = 2.0 * view.slope_x / view.width;
  const double pixel_y = 2.0 * view.slope_y / view.height;
  const auto direction = [&to_world](double x, double y, double z, double w) {
    return glm::vec4(glm::dvec4(to_world * glm::dvec3(x, y, z), w));
  };
  shared::Frame frame{};
  frame.ray_origin = direction(-view.slope_x, -view.slope_y, -1.0, view.near);
  frame.ray_x = direction(pixel_x, 0.0, 0.0, 1.0 / pixel_x);
  frame.ray_y = direction(0.0, pixel_y, 0.0, largest_sprite);
  frame.viewport = {view.width, view.height, 1.0F / static_cast<float>(view.width),
                    1.0F / static_cast<float>(view.height)};
  for (std::size_t i = 0; i < kCameraLights.size(); ++i) {
    const glm::dvec3 d = glm::normalize(kCameraLights[i].direction);
    frame.light_direction[i] = direction(d.x, d.y, d.z, 0.0);
    frame.light_colour[i] = glm::vec4(kCameraLights[i].colour, 0.0F);
  }
  frame.light_ambient = glm::vec4(kAmbient, kAmbient, kAmbient, 0.0F);
  return frame;
}

}  // namespace relief
