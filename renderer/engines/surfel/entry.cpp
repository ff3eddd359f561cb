// The registry's entry of the engine `surfel`.
#include "renderer/clip/options.h"
#include "renderer/engine_options.h"
#include "renderer/engines/surfel/render_surfel.h"
#include "renderer/engines/surfel/select_surfels.h"
#include "renderer/surfels/settings.h"

namespace relief::surfel {
namespace {

std::vector<EngineOption> options() {
  std::vector<EngineOption> all = {
      cull_option(),
      samples_option(),
      pixels_per_sample_option(
          "draws one mean surfel for several that are seen at most P pixels wide together; 0 draws "
          "all",
          "1", pixels_per_surfel_of),
      choice_option({.key = "surfel-size",
                     .help = "what sizes come from: a split of space (BSP) into triangles, their "
                             "mean edge or their circle; the spheres of QSplat; the cells of the "
                             "nearest points; or the points' own spacing (given)",
                     .default_text = "cell"},
                    kSurfelSizes,
                    {SurfelSize::BspEdge, SurfelSize::BspCircle, SurfelSize::Qsplat,
                     SurfelSize::Cell, SurfelSize::Given},
                    [](RenderSettings& s) -> SurfelSize& { return s.surfel.size; }),
      optional_number_option(
          {.key = "surfel-scale",
           .range = kSurfelScales,
           .placeholder = "F",
           .help = "factor of the surfels' sizes",
           .default_text = "what closes the gaps of --surfel-size"},
          [](RenderSettings & s) -> auto& { return s.surfel.scale; }),
      number_option({.key = "surfel-sides",
                     .range = kSurfelSides,
                     .placeholder = "N",
                     .help = "sides of the polygon about a surfel's disc, which is cut out of it",
                     .default_text = "3"},
                    [](RenderSettings& s) -> int& { return s.surfel.sides; }),
      choice_option({.key = "surfel-curved",
                     .help = "which surfels bend with the surface instead of being flat: those at "
                             "its contour, all or none",
                     .default_text = "auto"},
                    kSurfelCurved, {SurfelCurved::Auto, SurfelCurved::All, SurfelCurved::None},
                    [](RenderSettings& s) -> SurfelCurved& { return s.surfel.curved; }),
      choice_option({.key = "surfel-blend",
                     .help = "normalised: the weighted mean of what is in front; sorted: each "
                             "surfel, shaded, over what is behind it",
                     .default_text = "normalised"},
                    kSurfelBlends, {SurfelBlend::Normalised, SurfelBlend::Sorted},
                    [](RenderSettings& s) -> SurfelBlend& { return s.surfel.blend; }),
      number_option({.key = "surfel-falloff",
                     .range = kSurfelFalloffs,
                     .placeholder = "H",
                     .help = "how fast surfels fade: the weight is exp(-d^2/H^2) at d radii from "
                             "the centre",
                     .default_text = "0.5"},
                    [](RenderSettings& s) -> double& { return s.surfel.falloff; }),
      optional_number_option(
          {.key = "surfel-offset",
           .range = kSurfelOffsets,
           .placeholder = "Z",
           .help =
               "how far the first pass is set back from the eye, in world units: surfels within "
               "that of the front one blend with it",
           .default_text = "each surfel's radius"},
          [](RenderSettings & s) -> auto& { return s.surfel.offset; })};
  for (EngineOption& option : clip_options()) all.push_back(std::move(option));
  return all;
}

}  // namespace

EngineEntry entry() {
  return {.name = "surfel",
          .summary =
              "draws points as textured surfels [Textured surfels] with OpenGL: those of a "
              "scan, or the samples of patches",
          .forms = {ModelForm::Splats, ModelForm::Patches},
          .primitives = {},
          .interpolations = {},
          .capabilities = {.needs_opengl = true,
                           .cull_modes = true,
                           .samples_per_pixel = true,
                           .explanation = true,
                           .clips_splats = true,
                           .textures_splats = true},
          .options = options(),
          .features = features_of,
          .prepare = prepare};
}

}  // namespace relief::surfel
