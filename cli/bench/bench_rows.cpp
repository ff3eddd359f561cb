#include "cli/bench/bench_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "cli/reports/option_values.h"
#include "loader/scene/view_settings.h"

namespace relief::cli {
namespace {

/// The keys of what an engine's variants choose.
std::vector<std::string> variant_keys(const EngineEntry& engine) {
  std::vector<std::string> keys;
  for (const auto* const variants : {&engine.bench_variants, &engine.compared_variants}) {
    for (const OptionValues& variant : *variants) {
      for (const auto& [key, value] : variant) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
      }
    }
  }
  return keys;
}

bool has_name(const std::vector<RenderSettings>& rows, const std::string& name) {
  return std::any_of(rows.begin(), rows.end(),
                     [&name](const RenderSettings& row) { return name_of_row(row) == name; });
}

/// The engine of a row, which bench_row found.
const EngineEntry& engine_of_row(const RenderSettings& row) {
  const EngineEntry* const engine = find_engine(row.engine);
  assert(engine != nullptr && "rows are made of the registry's engines");
  return *engine;
}

/// Returns whether an option has the default value of the row's engine.
bool has_default(const RenderSettings& row, const std::string& key) {
  const EngineEntry& engine = engine_of_row(row);
  const EngineOption* const option = find_option(engine, key);
  assert(option != nullptr && "variants are made of the engine's options");
  return option->get(row) == option->get(default_settings(engine));
}

/// The engine, its options of these keys, and whether splats are clipped.
std::string name_with(const RenderSettings& row, const std::vector<std::string>& keys) {
  std::vector<std::string> parts = options_as_text(row, keys);
  parts.insert(parts.begin(), row.engine);
  if (row.clip.rule == ClipRule::Partners) {
    parts.emplace_back("clipped");
  } else if (row.clip.rule != ClipRule::Off) {
    parts.push_back(fmt::format("clipped by {}", name_of(kClipRules, row.clip.rule)));
  }
  return fmt::format("{}", fmt::join(parts, " "));
}

}  // namespace

Result<RenderSettings> bench_row(const BenchView& view, const EngineEntry& engine,
                                 const OptionValues& values) {
  PlannedView row = view.view;
  row.settings.engine = engine.name;
  for (const std::string& key : variant_keys(engine)) row.settings.options.erase(key);
  row.settings.options = overlay_options(std::move(row.settings.options), values);
  RELIEF_TRY_ASSIGN(auto settings, render_settings_of(view.plan, row, view.extent));
  settings.background.reset();
  settings.outputs = {};
  settings.platform = view.platform;
  return settings;
}

Result<std::vector<RenderSettings>> bench_rows(const BenchView& view) {
  std::vector<RenderSettings> rows;
  for (const EngineEntry& engine : engines()) {
    if (!engine.capabilities.needs_opengl) continue;
    for (const OptionValues& variant : engine.bench_variants) {
      RELIEF_TRY_ASSIGN(auto row, bench_row(view, engine, variant));
      rows.push_back(std::move(row));
    }
    for (const std::string& key : variant_keys(engine)) {
      const auto set = view.view.settings.options.find(key);
      if (set == view.view.settings.options.end() || set->second.index() != 0) continue;
      RELIEF_TRY_ASSIGN(auto row, bench_row(view, engine, {{key, set->second}}));
      if (!has_name(rows, name_of_row(row))) rows.push_back(std::move(row));
    }
  }
  return rows;
}

Result<std::vector<RenderSettings>> compared_rows(const BenchView& view) {
  RELIEF_TRY_ASSIGN(const EngineEntry* const rival, engine_named(kRivalEngine));
  RELIEF_TRY_ASSIGN(auto row, bench_row(view, engines().front(), {}));
  RELIEF_TRY_ASSIGN(auto compared, bench_row(view, *rival, {}));
  return std::vector<RenderSettings>{std::move(row), std::move(compared)};
}

Result<std::vector<RenderSettings>> swept_rows(const BenchView& view, const std::string& key,
                                               const std::vector<double>& values) {
  const auto all = engines();
  const auto engine = std::find_if(all.begin(), all.end(), [&key](const EngineEntry& e) {
    return e.capabilities.needs_opengl && find_option(e, key) != nullptr;
  });
  if (engine == all.end()) return make_error("no engine on OpenGL has an option {}", key);
  std::vector<RenderSettings> rows;
  for (const double value : values) {
    RELIEF_TRY_ASSIGN(auto row, bench_row(view, *engine, {{key, value}}));
    rows.push_back(std::move(row));
  }
  return rows;
}

std::string name_of_row(const RenderSettings& row) {
  return name_with(row, variant_keys(engine_of_row(row)));
}

std::string short_name_of_row(const RenderSettings& row) {
  std::vector<std::string> keys = variant_keys(engine_of_row(row));
  std::erase_if(keys, [&row](const std::string& key) {
    return find_option(engine_of_row(row), key)->row.kind != OptionKind::Choice &&
           has_default(row, key);
  });
  return name_with(row, keys);
}

bool has_default_numbers(const RenderSettings& row) {
  const std::vector<std::string> keys = variant_keys(engine_of_row(row));
  return std::all_of(keys.begin(), keys.end(), [&row](const std::string& key) {
    return find_option(engine_of_row(row), key)->row.kind == OptionKind::Choice ||
           has_default(row, key);
  });
}

bool is_default(const RenderSettings& row) {
  const std::vector<std::string> keys = variant_keys(engine_of_row(row));
  return row.engine == engines().front().name &&
         std::all_of(keys.begin(), keys.end(),
                     [&row](const std::string& key) { return has_default(row, key); });
}

std::size_t find_default(const std::vector<RenderSettings>& rows) {
  const auto found = std::find_if(rows.begin(), rows.end(), is_default);
  assert(found != rows.end() && "one row is the default");
  return static_cast<std::size_t>(found - rows.begin());
}

}  // namespace relief::cli
