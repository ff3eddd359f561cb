// The registry's entry of the engine `volume`.
#include "renderer/engines/volume/render_volume.h"
#include "renderer/frame/features.h"
#include "renderer/volume/options.h"

namespace relief::volume {

EngineEntry entry() {
  return {.name = "volume",
          .summary = "splats volumes and 3D Gaussians with EWA filtering [Zwicker 2002] on OpenGL",
          .forms = {ModelForm::Volume, ModelForm::Gaussians, ModelForm::VolumeParts},
          .surfaces_by = "onepass",
          .primitives = {},
          .interpolations = {},
          .capabilities = {.needs_opengl = true, .explanation = true},
          .options = volume_options(),
          .features = features_of,
          .prepare = prepare};
}

}  // namespace relief::volume
