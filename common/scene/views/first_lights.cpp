#include "common/scene/views/first_lights.h"

#include <array>

#include "common/scene/views/standing_direction.h"
#include "common/scene/views/view_camera.h"

namespace relief {
namespace {

/// A light of the sun's set, by where it stands (standing_direction).
struct StandingLight {
  double azimuth_degrees;
  double elevation_degrees;
  glm::vec3 colour;  ///< linear
};

/// Maps have the sun at 315 degrees. From the usual view, out of the south-south-east, that lights
/// what faces away; 15 degrees less do not. Slopes of 10 degrees differ by a third in light this
/// low, by a fifth in that of 45 degrees, as maps have it. The ground's light keeps undersides from
/// black. Level ground has 0.8 of white.
constexpr std::array<StandingLight, 3> kSun{StandingLight{-120.0, 32.0, {1.25F, 1.20F, 1.12F}},
                                            StandingLight{0.0, 90.0, {0.08F, 0.10F, 0.13F}},
                                            StandingLight{60.0, -40.0, {0.12F, 0.12F, 0.12F}}};
constexpr glm::vec3 kAmbient{0.045F, 0.05F, 0.06F};
// Ground is no glaze: with the usual quarter slopes that face the sun look wet.
constexpr float kHighlight = 0.03F;

}  // namespace

Lights first_lights(const SceneSettings& settings, const PatchModel& model) {
  const Stance stance = stance_of(settings, model);
  Lights lights;
  lights.ambient = settings.ambient.value_or(lights.ambient);
  if (model.is_closed || !is_flat(model, stance)) return lights;
  for (const StandingLight& light : kSun) {
    lights.list.push_back(
        {LightKind::Directional,
         standing_direction(stance, light.azimuth_degrees, light.elevation_degrees), light.colour});
  }
  lights.ambient = settings.ambient.value_or(kAmbient);
  lights.highlight = kHighlight;
  return lights;
}

}  // namespace relief
