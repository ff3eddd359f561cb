#include "renderer/engine_options.h"

#include <utility>

#include "renderer/frame/image_parts.h"

namespace relief {

EngineOption own_option(OptionRow row, OptionValue fallback) {
  const std::string key = row.key;
  return {std::move(row),
          [key](RenderSettings& settings, const OptionValue& value) {
            settings.options.insert_or_assign(key, value);
          },
          [key, fallback = std::move(fallback)](const RenderSettings& settings) {
            const auto found = settings.options.find(key);
            return std::optional<OptionValue>(found == settings.options.end() ? fallback
                                                                              : found->second);
          }};
}

EngineOption primitive_option(const std::vector<Primitive>& primitives) {
  return choice_option({.key = "primitive",
                        .help = "what is rasterised: a sprite or a quad for each sample, or the "
                                "cells between the samples",
                        .default_text = std::string(name_of(kPrimitives, primitives.front()))},
                       kPrimitives, primitives,
                       [](RenderSettings& settings) -> Primitive& { return settings.primitive; });
}

EngineOption interpolation_option(const std::vector<Interpolation>& interpolations) {
  return choice_option(
      {.key = "interpolation",
       .help =
           "how a fragment finds its position on the patch: direct is faster, corrected is more "
           "exact",
       .default_text = std::string(name_of(kInterpolations, interpolations.front()))},
      kInterpolations, interpolations,
      [](RenderSettings& settings) -> Interpolation& { return settings.interpolation; });
}

EngineOption cull_option() {
  return choice_option(
      {.key = "cull",
       .help = "which faces are not drawn: safe leaves out faces that look away from the eye of "
               "closed models whose patches meet at seams, drawn as cells and seen from outside; "
               "auto of all closed models seen from outside; back of all; none draws both sides",
       .default_text = "safe"},
      kCullModes, {CullMode::Safe, CullMode::Auto, CullMode::Back, CullMode::None},
      [](RenderSettings& settings) -> CullMode& { return settings.cull; });
}

EngineOption samples_option() {
  EngineOption option = number_option(
      {.key = "samples",
       .range = kSampleCounts,
       .placeholder = "N",
       .help = "samples a pixel, in a square grid of at least N; 1 is not antialiased",
       .default_text = "1"},
      [](RenderSettings& settings) -> int& { return settings.samples; });
  option.get = [](const RenderSettings& settings) {
    const auto side = static_cast<double>(samples_a_side(settings.samples));
    return std::optional<OptionValue>(side * side);
  };
  return option;
}

EngineOption pixels_per_sample_option(std::string help, std::string default_text,
                                      double (*in_force)(const RenderSettings&)) {
  EngineOption option = number_option(
      {.key = "pixels-per-sample",
       .range = kPixelsPerSample,
       .placeholder = "P",
       .help = std::move(help),
       .default_text = std::move(default_text)},
      [](RenderSettings& settings) -> double& { return settings.pixels_per_sample.emplace(); });
  option.get = [in_force](const RenderSettings& settings) {
    return std::optional<OptionValue>(in_force(settings));
  };
  return option;
}

}  // namespace relief
