#include "loader/scene/first_look.h"

#include "common/image/srgb.h"
#include "loader/scene/view_settings.h"

namespace relief {
namespace {

/// sRGB. Between the shaded side of a grey model and its lit one; decided on all scans at hand
/// (docs/decisions/0111).
constexpr float kBackground = 0.25F;

bool has_colours(const LoadedScene& scene) {
  return scene.patches.has_colours ||
         (scene.mesh && (!scene.mesh->colours.empty() || !scene.mesh->textures.empty())) ||
         (scene.splats && !scene.splats->colours.empty());
}

}  // namespace

bool is_unlit_at_first(const SceneSettings& planned, const ShownColours& colours) {
  // Colours that stand for numbers say nothing of the shape: light does. A mesh without light is
  // flat.
  return !planned.material && colours.are_there && !colours.stand_for_numbers &&
         !colours.are_on_faces;
}

bool asks_for_samples(const SceneSettings& planned) {
  return planned.options.contains("samples");
}

void complete_look(const PlannedView& view, const LoadedScene& scene, RenderSettings& settings) {
  const SceneSettings& planned = view.settings;
  if (!planned.background) settings.background = glm::vec3(linear_from_srgb(kBackground));
  const auto engine = engine_of(view);
  const bool is_timed = settings.frames > 0 || settings.explain || settings.pass_frames > 0;
  // Kernels are filtered: only surfaces among them have samples.
  const bool has_samples =
      !scene.has_kernels() || (scene.volumes && !scene.patches.patches.empty());
  if (engine && (*engine)->capabilities.needs_opengl && has_samples && !is_timed &&
      !asks_for_samples(planned))
    settings.samples = kPictureSamples;
  if (!is_unlit_at_first(planned, {has_colours(scene), scene.colours.has_value(), scene.has_faces}))
    return;
  // A volume's colours need light, too.
  settings.volume.material = settings.material;
  for (VolumeSettings& of_volume : settings.volumes) of_volume.material = settings.material;
  settings.material = Material::Unlit;
}

}  // namespace relief
