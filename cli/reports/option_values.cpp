#include "cli/reports/option_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

namespace relief::cli {
namespace {

nlohmann::ordered_json value_as_json(const OptionRow& row, const OptionValue& value) {
  if (const auto* const name = std::get_if<std::string>(&value)) return *name;
  const double number = std::get<double>(value);
  if (row.kind == OptionKind::Integer) return static_cast<std::int64_t>(number);
  return number;
}

std::string options_key(std::string key) {
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

/// The option as a report names it; empty for a number that is 0. Choices speak for themselves, but
/// for those that leave the choice open.
std::string option_as_text(const EngineOption& option, const RenderSettings& settings) {
  const auto value = option.get(settings);
  if (!value) return {};
  if (const auto* const name = std::get_if<std::string>(&*value)) {
    const bool is_clear = option.row.kind == OptionKind::Choice && *name != "auto";
    return is_clear ? *name : fmt::format("{} {}", option.row.key, *name);
  }
  const double number = std::get<double>(*value);
  return number == 0.0 ? std::string() : fmt::format("{} {:g}", option.row.key, number);
}

}  // namespace

nlohmann::ordered_json options_as_json(const RenderSettings& settings) {
  const EngineEntry* const engine = find_engine(settings.engine);
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const SharedOption& shared : shared_options()) {
    const EngineOption* const option =
        engine == nullptr ? nullptr : find_option(*engine, shared.row.key);
    const auto value = option == nullptr ? std::nullopt : option->get(settings);
    json[options_key(shared.row.key)] =
        value ? value_as_json(shared.row, *value) : nlohmann::ordered_json(nullptr);
  }
  return json;
}

std::vector<std::string> options_as_text(const RenderSettings& settings) {
  std::vector<std::string> keys;
  if (const EngineEntry* const engine = find_engine(settings.engine)) {
    for (const EngineOption& option : engine->options) keys.push_back(option.row.key);
  }
  return options_as_text(settings, keys);
}

std::vector<std::string> options_as_text(const RenderSettings& settings,
                                         const std::vector<std::string>& keys) {
  std::vector<std::string> texts;
  const EngineEntry* const engine = find_engine(settings.engine);
  if (engine == nullptr) return texts;
  for (const EngineOption& option : engine->options) {
    if (std::find(keys.begin(), keys.end(), option.row.key) == keys.end()) continue;
    std::string text = option_as_text(option, settings);
    if (!text.empty()) texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace relief::cli
