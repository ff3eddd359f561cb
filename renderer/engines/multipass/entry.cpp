// The registry's entry of the engine `multipass`.
#include "renderer/clip/options.h"
#include "renderer/engine_options.h"
#include "renderer/engines/multipass/render_multipass.h"
#include "renderer/frame/features.h"

namespace relief::multipass {

namespace {

std::vector<EngineOption> options(const std::vector<Primitive>& primitives) {
  std::vector<EngineOption> all = {
      primitive_option(primitives), cull_option(), samples_option(),
      number_option(
          {.key = "radius-factor",
           .range = kRadiusFactors,
           .placeholder = "F",
           .help = "radius of the splats, over that of onepass's sprites",
           .default_text = "2"},
          [](RenderSettings& settings) -> double& { return settings.multipass.radius_factor; })};
  for (EngineOption& option : clip_options()) all.push_back(std::move(option));
  return all;
}

}  // namespace

EngineEntry entry() {
  const std::vector<Primitive> primitives{Primitive::Quad, Primitive::Sprite};
  return {.name = "multipass",
          .summary = "splats the samples of patches in three passes, shaded last, with OpenGL",
          .forms = {ModelForm::Patches},
          .primitives = primitives,
          .interpolations = {},
          .capabilities = {.needs_opengl = true,
                           .cull_modes = true,
                           .samples_per_pixel = true,
                           .explanation = true,
                           .clips_splats = true},
          .options = options(primitives),
          .bench_variants = {{{"primitive", "sprite"}, {"radius-factor", 1.0}},
                             {{"primitive", "sprite"}, {"radius-factor", 2.0}},
                             {{"primitive", "quad"}, {"radius-factor", 1.0}},
                             {{"primitive", "quad"}, {"radius-factor", 2.0}}},
          .features = scene_features,
          .prepare = prepare};
}

}  // namespace relief::multipass
