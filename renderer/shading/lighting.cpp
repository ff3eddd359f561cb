#include "renderer/shading/lighting.h"

#include <array>
#include <cassert>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace relief {
namespace {

/// A light in eye coordinates.
struct CameraLight {
  glm::dvec3 direction;  ///< toward the light, any length
  glm::vec3 colour;      ///< linear; what a white surface facing it sends back
};

/// Whatever side of a scan is looked at is lit: key from the upper left, fill from the right, rim
/// from behind and above. Together with the ambient light a white surface facing the eye comes out
/// just below 1.
const std::array<CameraLight, 3> kCameraLights{
    CameraLight{{-0.5, 0.7, 0.9}, {0.80F, 0.78F, 0.74F}},
    CameraLight{{0.9, 0.1, 0.6}, {0.24F, 0.26F, 0.30F}},
    CameraLight{{0.1, 0.8, -0.6}, {0.35F, 0.35F, 0.38F}}};

static_assert(kMaxLights == shared::kMaxLights && kMaxLight == shared::kBrightestLight);

void set_camera_lights(shared::Frame& frame, const View& view) {
  const glm::dmat3 to_world = glm::transpose(view.rotation);
  for (std::size_t i = 0; i < kCameraLights.size(); ++i) {
    frame.light_position[i] =
        glm::vec4(glm::dvec4(to_world * glm::normalize(kCameraLights[i].direction), 0.0));
    frame.light_colour[i] = glm::vec4(kCameraLights[i].colour, 0.0F);
  }
}

bool has_camera_lights(const Lights& lights) {
  return lights.list.empty() && !lights.from_environment;
}

}  // namespace

int count_lights(const Lights& lights) {
  return static_cast<int>(has_camera_lights(lights) ? kCameraLights.size() : lights.list.size());
}

void set_lights(shared::Frame& frame, const View& view, const Lights& lights) {
  assert(lights.list.size() <= kMaxLights && "no more lights than a frame has room for");
  frame.light_ambient = glm::vec4(lights.ambient, lights.highlight);
  if (has_camera_lights(lights)) set_camera_lights(frame, view);
  for (std::size_t i = 0; i < lights.list.size(); ++i) {
    const Light& light = lights.list[i];
    const bool is_point = light.kind == LightKind::Point;
    const glm::dvec3 toward = is_point ? light.position - view.eye : light.position;
    frame.light_position[i] = glm::vec4(glm::dvec4(toward, is_point ? 1.0 : 0.0));
    frame.light_colour[i] = glm::vec4(light.colour, 0.0F);
  }
}

}  // namespace relief
