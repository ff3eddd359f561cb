#include "tests/experiments/draw_unlit.h"

#include <utility>

#include "renderer/render.h"

namespace relief::experiment {

Result<Image> draw_unlit(const SplatCloud& cloud, const Camera& camera, std::uint32_t side,
                         const EwaSettings& ewa) {
  Progress progress;
  RenderSettings settings;
  settings.engine = "ewa";
  settings.width = settings.height = side;
  settings.camera = camera;
  settings.material = Material::Unlit;
  settings.frames = 1;
  settings.ewa = ewa;
  auto result = render(cloud, settings, progress);
  if (!result) return result.error();
  return std::move(result->image);
}

}  // namespace relief::experiment
