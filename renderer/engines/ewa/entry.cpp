// The registry's entry of the engine `ewa`.
#include "renderer/clip/options.h"
#include "renderer/engine_options.h"
#include "renderer/engines/ewa/render_ewa.h"

namespace relief::ewa {
namespace {

std::vector<EngineOption> options() {
  std::vector<EngineOption> all = {
      choice_option(
          {.key = "filter",
           .help = "the resampling filter; all but ewa are for comparison",
           .default_text = "ewa"},
          kFilters,
          {EwaFilter::Ewa, EwaFilter::SourceSpace, EwaFilter::Circular, EwaFilter::Unfiltered},
          [](RenderSettings& settings) -> EwaFilter& { return settings.ewa.filter; }),
      number_option({.key = "cutoff",
                     .range = kCutoffs,
                     .placeholder = "C",
                     .help = "where kernels end, as an exponent; larger is better and slower",
                     .default_text = "1"},
                    [](RenderSettings& settings) -> double& { return settings.ewa.cutoff; }),
      number_option({.key = "layers",
                     .range = kLayerCounts,
                     .placeholder = "L",
                     .help = "surfaces behind one another that a pixel keeps apart",
                     .default_text = "4"},
                    [](RenderSettings& settings) -> int& { return settings.ewa.layers; }),
      number_option(
          {.key = "tau",
           .range = kCoverageThresholds,
           .placeholder = "T",
           .help = "sum of kernels from which on a pixel is covered",
           .default_text = "0.4"},
          [](RenderSettings& settings) -> double& { return settings.ewa.coverage_threshold; }),
      number_option(
          {.key = "time-budget",
           .range = kTimeBudgets,
           .placeholder = "MS",
           .help = "milliseconds; draws coarser sets of points first, and finer ones while this "
                   "time lasts",
           .default_text = ""},
          [](RenderSettings& settings) -> double& { return settings.ewa.time_budget_ms; })};
  for (EngineOption& option : clip_options()) all.push_back(std::move(option));
  return all;
}

}  // namespace

EngineEntry entry() {
  return {.name = "ewa",
          .summary =
              "splats points with EWA filtering [Zwicker 2001] on the CPU: those of a scan, "
              "or the samples of patches",
          .forms = {ModelForm::Splats, ModelForm::Patches},
          .primitives = {},
          .interpolations = {},
          .capabilities = {.transparency = Support::always(), .clips_splats = true},
          .options = options(),
          .prepare = prepare};
}

}  // namespace relief::ewa
