// The registry's entry of the engine `volume`.
#include "renderer/engine_options.h"
#include "renderer/engines/volume/render_volume.h"
#include "renderer/frame/features.h"
#include "renderer/volume/options.h"

namespace relief::volume {
namespace {

std::vector<EngineOption> options() {
  std::vector<EngineOption> options = volume_options();
  options.push_back(coarse_option());
  options.push_back(
      choice_option({.key = "drawn-by",
                     .help = "what draws kernels: shaders, or the CPU without OpenGL",
                     .default_text = "cpu where OpenGL draws on the CPU, else shaders"},
                    kVolumeDrawingsBy,
                    {VolumeDrawingBy::Automatic, VolumeDrawingBy::Shaders, VolumeDrawingBy::Cpu},
                    [](RenderSettings& s) -> VolumeDrawingBy& { return s.volume.drawn_by; }));
  return options;
}

}  // namespace

EngineEntry entry() {
  return {.name = "volume",
          .summary = "splats volumes and 3D Gaussians with EWA filtering [Zwicker 2002] on OpenGL",
          .forms = {ModelForm::Volume, ModelForm::Gaussians, ModelForm::VolumeParts},
          .surfaces_by = "onepass",
          .primitives = {},
          .interpolations = {},
          .capabilities = {.needs_opengl = true, .explanation = true},
          .options = options(),
          .features = features_of,
          .prepare = prepare};
}

}  // namespace relief::volume
