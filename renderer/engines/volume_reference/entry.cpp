// The registry's entry of the engine `volume-reference`.
#include "renderer/engine_options.h"
#include "renderer/engines/volume_reference/render_volume_reference.h"
#include "renderer/volume/options.h"

namespace relief::volume_reference {

namespace {

std::vector<EngineOption> all_options() {
  std::vector<EngineOption> options = volume_options();
  options.push_back(number_option(
      {.key = "pixels-per-node",
       .range = kPixelsPerNode,
       .placeholder = "P",
       .help =
           "draws a regular grid as coarsely as its nodes are seen at most so many pixels apart; "
           "0: as it is",
       .default_text = "0"},
      [](RenderSettings& settings) -> double& { return settings.volume.pixels_per_node; }));
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
