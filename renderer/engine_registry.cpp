#include "renderer/engine_registry.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <string>

namespace relief {

/// One line an engine: the folder in renderer/engines/ that defines its entry().
#define RELIEF_ENGINES(F) \
  F(onepass)              \
  F(multipass)            \
  F(ewa)                  \
  F(surfel)               \
  F(raytrace)             \
  F(volume)               \
  F(volume_reference)     \
  F(volume_truth)

#define RELIEF_ENGINE_DECLARED(folder) \
  namespace folder {                   \
  EngineEntry entry();                 \
  }
RELIEF_ENGINES(RELIEF_ENGINE_DECLARED)
#undef RELIEF_ENGINE_DECLARED

std::span<const EngineEntry> engines() {
#define RELIEF_ENGINE_LISTED(folder) folder::entry(),
  static const std::array entries{RELIEF_ENGINES(RELIEF_ENGINE_LISTED)};
#undef RELIEF_ENGINE_LISTED
  return entries;
}

const EngineEntry* find_engine(std::string_view name, std::span<const EngineEntry> among) {
  const auto found = std::find_if(among.begin(), among.end(),
                                  [name](const EngineEntry& e) { return e.name == name; });
  return found == among.end() ? nullptr : &*found;
}

Result<const EngineEntry*> engine_named(std::string_view name, std::span<const EngineEntry> among) {
  if (const EngineEntry* const found = find_engine(name, among)) return found;
  std::vector<std::string_view> names;
  std::transform(among.begin(), among.end(), std::back_inserter(names),
                 [](const EngineEntry& engine) { return std::string_view(engine.name); });
  return make_error("there is no engine {}; take one of {}", name, fmt::join(names, ", "));
}

bool needs_opengl(std::string_view name) {
  const EngineEntry* const engine = find_engine(name);
  return engine != nullptr && engine->capabilities.needs_opengl;
}

RenderSettings default_settings(const EngineEntry& engine) {
  RenderSettings settings;
  settings.engine = engine.name;
  if (!engine.primitives.empty()) settings.primitive = engine.primitives.front();
  if (!engine.interpolations.empty()) settings.interpolation = engine.interpolations.front();
  return settings;
}

const EngineOption* find_option(const EngineEntry& engine, std::string_view key) {
  const auto found = std::find_if(engine.options.begin(), engine.options.end(),
                                  [key](const EngineOption& o) { return o.row.key == key; });
  return found == engine.options.end() ? nullptr : &*found;
}

Status apply_options(const EngineEntry& engine, const OptionValues& values,
                     RenderSettings& settings) {
  for (const auto& [key, value] : values) {
    const EngineOption* const option = find_option(engine, key);
    if (option == nullptr) return make_error("engine {} has no option {}", engine.name, key);
    if (const Status good = check_value(option->row, value); !good)
      return make_error("{} of engine {}: {}", key, engine.name, good.error().message);
    option->set(settings, value);
  }
  return {};
}

namespace {

/// Accepts what another engine's option of the same key does, too.
void widen(OptionRow& row, const OptionRow& other) {
  row.range.min = std::min(row.range.min, other.range.min);
  row.range.max = std::max(row.range.max, other.range.max);
  for (const std::string& choice : other.choices) {
    if (std::find(row.choices.begin(), row.choices.end(), choice) == row.choices.end())
      row.choices.push_back(choice);
  }
}

}  // namespace

std::vector<SharedOption> shared_options(std::span<const EngineEntry> among) {
  std::vector<SharedOption> all;
  for (const EngineEntry& engine : among) {
    for (const EngineOption& option : engine.options) {
      auto known = std::find_if(all.begin(), all.end(), [&option](const SharedOption& shared) {
        return shared.row.key == option.row.key;
      });
      if (known == all.end()) known = all.insert(all.end(), SharedOption{option.row, {}, {}});
      widen(known->row, option.row);
      known->engines.push_back(&engine);
      known->options.push_back(&option);
    }
  }
  return all;
}

std::optional<ModelForm> form_for(const EngineEntry& engine, const RenderModel& model) {
  const auto found = std::find_if(engine.forms.begin(), engine.forms.end(),
                                  [&model](ModelForm form) { return model.has(form); });
  return found == engine.forms.end() ? std::nullopt : std::optional(*found);
}

}  // namespace relief
