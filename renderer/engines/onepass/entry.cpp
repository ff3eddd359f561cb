// The registry's entry of the engine `onepass`.
#include "renderer/engine_options.h"
#include "renderer/engines/onepass/features.h"
#include "renderer/engines/onepass/render_onepass.h"

namespace relief::onepass {
namespace {

/// Cells are the surface, so that the interpolation is only that of their border splats: they have
/// a variant for each policy of levels (the finest, the default, twice as coarse).
std::vector<OptionValues> bench_variants() {
  const auto variant = [](const char* primitive, const char* interpolation, double pixels) {
    return OptionValues{
        {"primitive", primitive}, {"interpolation", interpolation}, {"pixels-per-sample", pixels}};
  };
  return {variant("sprite", "direct", 0.0),
          variant("sprite", "corrected", 0.0),
          variant("quad", "direct", 0.0),
          variant("quad", "corrected", 0.0),
          variant("cell", "corrected", 0.0),
          variant("cell", "corrected", kPixelsPerSampleOfCells),
          variant("cell", "corrected", 2.0 * kPixelsPerSampleOfCells)};
}

}  // namespace

EngineEntry entry() {
  const std::vector<Primitive> primitives{Primitive::Cell, Primitive::Quad, Primitive::Sprite};
  const std::vector<Interpolation> interpolations{Interpolation::Corrected, Interpolation::Direct};
  return {.name = "onepass",
          .summary = "draws patches in one pass [Ochotta 2008], with OpenGL",
          .forms = {ModelForm::Patches},
          .primitives = primitives,
          .interpolations = interpolations,
          .capabilities = {.needs_opengl = true,
                           .transparency = Support::with(Primitive::Cell),
                           .two_interfaces = Support::with(Primitive::Cell),
                           .split_view = Support::always(),
                           .cull_modes = true,
                           .samples_per_pixel = true,
                           .levels_of_detail = true,
                           .explanation = true},
          .options = {primitive_option(primitives), interpolation_option(interpolations),
                      cull_option(), samples_option(),
                      pixels_per_sample_option(
                          "draws coarser levels of patches where their samples are seen at most P "
                          "pixels apart, of patches that meet also off the finest by at most P/128 "
                          "pixels; 0 always draws the finest",
                          "4 with cells, else 0", pixels_per_sample_of)},
          .bench_variants = bench_variants(),
          .compared_variants = {{{"primitive", "quad"}, {"interpolation", "direct"}},
                                {{"primitive", "quad"}, {"interpolation", "corrected"}},
                                {}},
          .features = features_of,
          .prepare = prepare};
}

}  // namespace relief::onepass
