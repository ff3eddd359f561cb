#include "cli/options/quality.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cassert>
#include <string>
#include <variant>
#include <vector>

#include "cli/options/values.h"
#include "renderer/engine_registry.h"

namespace relief::cli {
namespace {

double number_in(const OptionValue& value) {
  return std::get<double>(value);
}

/// The options that say what the one of `key` says, so that any of them stands in its place.
std::vector<std::string> rivals_of(const std::string& key) {
  if (key == "samples-per-point") return {"samples-per-point", "spacing", "samples", "error"};
  if (key == "steps-per-spacing") return {"steps-per-spacing", "height-step"};
  return {key};
}

}  // namespace

QualityPreset preset_of(Quality quality) {
  switch (quality) {
    case Quality::Draft:
      return {{{"samples-per-point", 0.25}, {"codec", "compact"}, {"normal-degrees", 2.0}},
              {{"samples", 1.0}, {"pixels-per-sample", 8.0}}};
    case Quality::Exact:
      return {{{"samples-per-point", 2.0}, {"codec", "compact"}, {"normal-degrees", 0.1}},
              {{"samples", 16.0}, {"pixels-per-sample", 2.0}}};
    case Quality::Balanced:
      break;
  }
  return {};
}

void set_conversion(const OptionValues& values, ConvertOptions& options, PatchFileOptions& file) {
  for (const auto& [key, value] : values) {
    if (key == "samples-per-point") {
      options.samples_per_point = number_in(value);
    } else if (key == "steps-per-spacing") {
      options.steps_per_spacing = number_in(value);
    } else if (key == "cone-degrees") {
      options.cone_degrees = number_in(value);
    } else if (key == "normal-degrees") {
      file.normal_degrees = number_in(value);
    } else {
      assert(key == "codec" && "a preset has options of these keys only");
      file.codec =
          std::get<std::string>(value) == "compact" ? PatchCodec::Compact : PatchCodec::Fast;
    }
  }
}

void add_quality_option(CLI::App& sub, std::optional<Quality>& quality) {
  sub.add_option_function<std::string>(
         "--quality",
         [&quality](const std::string& name) {
           quality = find_named(kQualities, name);
           if (!quality) {
             throw CLI::ValidationError("--quality",
                                        "expected draft, balanced or exact; found " + name);
           }
         },
         "Preset of options (docs/trade.md): draft is fastest and smallest, exact is nearest to "
         "the "
         "scan; options that are given win (default balanced)")
      ->option_text("draft|balanced|exact");
}

OptionValues values_not_given(const OptionValues& preset, const CLI::App& sub) {
  OptionValues values;
  for (const auto& [key, value] : preset) {
    const std::vector<std::string> rivals = rivals_of(key);
    const bool is_given = std::any_of(
        rivals.begin(), rivals.end(),
        [&sub](const std::string& name) { return sub.get_option("--" + name)->count() > 0; });
    if (!is_given) values.emplace(key, value);
  }
  return values;
}

void complete_views(const OptionValues& preset, ScenePlan& plan) {
  const EngineEntry& usual = engines().front();
  for (PlannedView& view : plan.views) {
    if (view.settings.engine.value_or(usual.name) != usual.name) continue;
    for (const auto& [key, value] : preset) view.settings.options.emplace(key, value);
  }
}

}  // namespace relief::cli
