// The registry's entry of the engine `volume-reference`.
#include "renderer/engines/volume_reference/render_volume_reference.h"
#include "renderer/volume/options.h"

namespace relief::volume_reference {

namespace {

std::vector<EngineOption> all_options() {
  std::vector<EngineOption> options = volume_options();
  options.push_back(coarse_option());
  return options;
}

}  // namespace

EngineEntry entry() {
  return {.name = "volume-reference",
          .summary = "splats volumes and 3D Gaussians with EWA filtering [Zwicker 2002] on the CPU",
          .forms = {ModelForm::Volume, ModelForm::Gaussians, ModelForm::VolumeParts},
          .surfaces_by = "raytrace",
          .primitives = {},
          .interpolations = {},
          .capabilities = {},
          .options = all_options(),
          .prepare = prepare};
}

}  // namespace relief::volume_reference
