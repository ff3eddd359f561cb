// The section "Drawing": the engine and its options, from the engines' own tables.
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "viewer/choices/engine_choices.h"
#include "viewer/choices/volume_choices.h"
#include "viewer/panels/panels.h"
#include "viewer/panels/rows.h"

namespace relief {
namespace {

/// Wider ranges are easier to use on a logarithmic scale.
constexpr double kWideRange = 32.0;

void engine_row(const RenderSettings& drawn, Session& session) {
  const std::vector<const EngineEntry*> engines = engines_for(session.scene->forms());
  std::vector<std::string> names;
  std::optional<std::size_t> current;
  std::string help;
  for (const EngineEntry* engine : engines) {
    if (engine->name == drawn.engine) current = names.size();
    names.push_back(engine->name);
    help += fmt::format("{}{}: {}", help.empty() ? "" : "\n", names.back(), engine->summary);
  }
  const auto chosen = choice_row("Engine", help.c_str(), names, current);
  if (!chosen) return;
  choose_engine(edited_look(session), *engines[*chosen]);
  session.look_changed = true;
}

struct OptionContext {
  const EngineEntry& engine;
  const EngineOption& option;
  const RenderSettings& drawn;
  SceneSettings& look;
  const std::optional<NumberChoice>& volume_values;
};

/// A list of values to choose from; `choices` are their texts.
bool list_row(const OptionContext& of, const std::vector<std::string>& choices,
              const std::vector<OptionValue>& values) {
  const auto in_force = of.option.get(of.drawn);
  std::optional<std::size_t> current;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (in_force == values[k]) current = k;
  }
  const auto chosen = choice_row(label_of(of.option.row.key).c_str(),
                                 capitalised(of.option.row.help).c_str(), choices, current);
  if (!chosen) return false;
  choose_value(of.look, of.engine, of.option.row.key, values[*chosen]);
  return true;
}

bool choice_option_row(const OptionContext& of) {
  std::vector<std::string> names;
  std::vector<OptionValue> values;
  for (const std::string& choice : of.option.row.choices) {
    names.push_back(capitalised(choice));
    values.emplace_back(choice);
  }
  return list_row(of, names, values);
}

bool samples_row(const OptionContext& of) {
  std::vector<std::string> names;
  std::vector<OptionValue> values;
  for (const int count : offered_samples()) {
    names.push_back(std::to_string(count));
    values.emplace_back(static_cast<double>(count));
  }
  return list_row(of, names, values);
}

bool number_option_row(const OptionContext& of) {
  const OptionRow& row = of.option.row;
  const NumberChoice range =
      row.key == "iso" ? of.volume_values.value_or(row.range) : offered_range(row);
  const auto in_force = of.option.get(of.drawn);
  const double usual = in_force ? std::get<double>(*in_force) : range.min;
  std::optional<double> value;
  if (const auto given = of.look.options.find(row.key); given != of.look.options.end())
    value = std::get<double>(given->second);
  const std::string label = label_of(row.key);
  const std::string help = capitalised(row.help);
  const char* const format = row.kind == OptionKind::Integer ? "%.0f" : in_force ? "%.3g" : "off";
  const bool is_logarithmic = row.key != "iso" && range.max > kWideRange;
  if (!number_row({label.c_str(), help.c_str(), range, usual, format, is_logarithmic}, value))
    return false;
  if (value)
    choose_value(of.look, of.engine, row.key, *value);
  else
    of.look.options.erase(row.key);
  return true;
}

bool transfer_row(const OptionContext& of) {
  std::vector<std::string> names;
  std::vector<OptionValue> values;
  for (const std::string& name : offered_transfers(of.drawn.volume.transfer)) {
    names.push_back(std::filesystem::path(name).filename().string());
    values.emplace_back(name);
  }
  return list_row(of, names, values);
}

bool option_row(const OptionContext& of) {
  const std::string& key = of.option.row.key;
  const bool is_of_values = key == "transfer" || key == "iso";
  if (is_of_values && !of.volume_values) return false;  // there are only 3D Gaussians
  if (key == "transfer") return transfer_row(of);
  if (of.option.row.kind == OptionKind::Text) return false;  // given on the command line
  if (of.option.row.kind == OptionKind::Choice) return choice_option_row(of);
  return of.option.row.key == "samples" ? samples_row(of) : number_option_row(of);
}

void pace_row(Session& session) {
  std::optional<double> target = session.target_ms;
  if (!number_row({"Frame time",
                   "Time of a frame while something moves: coarser pictures and levels of detail "
                   "keep it",
                   kTargetMs, Preferences().target_ms, "%.0f ms", true},
                  target))
    return;
  session.target_ms = session.preferences.target_ms = target.value_or(Preferences().target_ms);
}

}  // namespace

void show_drawing(const PanelContext& panel) {
  Session& session = panel.session;
  if (session.scene == nullptr) {
    show_faint("There is no surface yet.");
    pace_row(session);
    return;
  }
  SceneSettings& look = edited_look(session);
  const auto drawn = settings_of(session, look);
  if (!drawn) return show_faint_wrapped(drawn.error().message.c_str());
  engine_row(*drawn, session);
  if (const EngineEntry* const engine = find_engine(drawn->engine)) {
    for (const EngineOption& option : engine->options)
      session.look_changed |= option_row({*engine, option, *drawn, look, session.volume_values});
  }
  pace_row(session);
}

}  // namespace relief
