// The registry's entry of the engine `raytrace`.
#include "renderer/engine_options.h"
#include "renderer/engines/raytrace/render_raytrace.h"

namespace relief::raytrace {

EngineEntry entry() {
  return {.name = "raytrace",
          .summary = "follows rays to the triangles of a mesh, or of patches, on the CPU",
          .forms = {ModelForm::Mesh, ModelForm::Patches},
          .primitives = {},
          .interpolations = {},
          .capabilities = {.transparency = Support::always(),
                           .two_interfaces = Support::always(),
                           .split_view = Support::always(),
                           .samples_per_pixel = true},
          .options = {number_option(
              {.key = "samples",
               .range = kSampleCounts,
               .placeholder = "N",
               .help = "rays a pixel; 1 is not antialiased",
               .default_text = "16"},
              [](RenderSettings& settings) -> int& { return settings.raytrace.samples; })},
          .prepare = prepare};
}

}  // namespace relief::raytrace
