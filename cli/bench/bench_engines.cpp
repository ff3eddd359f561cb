#include "cli/bench/bench_engines.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/Error.hpp>
#include <algorithm>
#include <utility>

#include "cli/options/values.h"

namespace relief::cli {
namespace {

constexpr const char* kAll = "all";

/// The option that clips splats at sharp edges, and its values in the rows.
constexpr const char* kClipKey = "clip-partners";

std::string clip_text(ClipRule rule) {
  return std::string(name_of(kClipRules, rule));
}

std::vector<std::string> names_of_comparable() {
  std::vector<std::string> names;
  for (const EngineEntry* engine : comparable_engines()) names.push_back(engine->name);
  return names;
}

}  // namespace

std::vector<const EngineEntry*> comparable_engines() {
  std::vector<const EngineEntry*> found;
  for (const EngineEntry& engine : relief::engines()) {
    const ModelForm preferred = engine.forms.front();
    if (preferred == ModelForm::Patches || preferred == ModelForm::Splats) found.push_back(&engine);
  }
  return found;
}

std::vector<const EngineEntry*> parse_engines(const std::string& text) {
  std::vector<const EngineEntry*> engines = comparable_engines();
  if (text == kAll) return engines;
  const std::vector<std::string_view> wanted = split(text, ',');
  const std::vector<std::string> names = names_of_comparable();
  for (const std::string_view name : wanted) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    throw CLI::ValidationError(
        "--engines", fmt::format("expected all, or some of {}, separated by commas; found {}",
                                 fmt::join(names, ", "), text));
  }
  std::erase_if(engines, [&wanted](const EngineEntry* engine) {
    return std::find(wanted.begin(), wanted.end(), engine->name) == wanted.end();
  });
  return engines;
}

bool draw_points(const std::vector<const EngineEntry*>& engines) {
  return std::any_of(engines.begin(), engines.end(), [](const EngineEntry* engine) {
    return engine->forms.front() == ModelForm::Splats;
  });
}

Result<std::vector<RenderSettings>> engine_rows(const BenchView& view,
                                                const std::vector<const EngineEntry*>& engines) {
  std::vector<RenderSettings> rows;
  for (const EngineEntry* engine : engines) {
    std::vector<OptionValues> variants = engine->compared_variants;
    if (variants.empty()) variants.emplace_back();
    const bool clips = find_option(*engine, kClipKey) != nullptr;
    for (OptionValues& variant : variants) {
      if (clips) variant.insert_or_assign(kClipKey, clip_text(ClipRule::Off));
      RELIEF_TRY_ASSIGN(auto row, bench_row(view, *engine, variant));
      rows.push_back(std::move(row));
      if (!clips) continue;
      variant.insert_or_assign(kClipKey, clip_text(ClipRule::Partners));
      RELIEF_TRY_ASSIGN(auto clipped, bench_row(view, *engine, variant));
      rows.push_back(std::move(clipped));
    }
  }
  return rows;
}

}  // namespace relief::cli
