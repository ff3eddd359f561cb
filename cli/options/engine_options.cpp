#include "cli/options/engine_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <vector>

namespace relief::cli {
namespace {

std::vector<std::string> names_of(std::span<const EngineEntry> among) {
  std::vector<std::string> names;
  names.reserve(among.size());
  for (const EngineEntry& engine : among) names.push_back(engine.name);
  return names;
}

std::string names_of(const std::vector<const EngineEntry*>& some) {
  std::vector<std::string> names;
  names.reserve(some.size());
  for (const EngineEntry* engine : some) names.push_back(engine->name);
  return fmt::format("{}", fmt::join(names, ", "));
}

/// "default 2"; "default cell, quad with multipass"; engines from `first` to `end` have one help.
std::string default_text(const SharedOption& option, std::size_t first, std::size_t end) {
  const std::string& usual = option.options[first]->row.default_text;
  if (usual.empty()) return "off by default";
  std::string text = "default " + usual;
  for (std::size_t k = first + 1; k < end; ++k) {
    const std::string& other = option.options[k]->row.default_text;
    if (other != usual) text += fmt::format(", {} with {}", other, option.engines[k]->name);
  }
  return text;
}

std::string range_text(const OptionRow& row) {
  if (row.kind == OptionKind::Choice || row.kind == OptionKind::Text) return {};
  return fmt::format(", {:g} to {:g}", row.range.min, row.range.max);
}

/// "; cell only with onepass", for choices that some of the engines do not have.
std::string choices_text(const SharedOption& option) {
  std::string text;
  for (const std::string& choice : option.row.choices) {
    std::vector<const EngineEntry*> having;
    for (std::size_t k = 0; k < option.engines.size(); ++k) {
      const auto& choices = option.options[k]->row.choices;
      if (std::find(choices.begin(), choices.end(), choice) != choices.end())
        having.push_back(option.engines[k]);
    }
    if (having.size() < option.engines.size())
      text += fmt::format("; {} only with {}", choice, names_of(having));
  }
  return text;
}

std::string capitalised(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text;
}

/// The options that the same engines have are a group.
std::string group_of(const SharedOption& option) {
  return "Options of " + names_of(option.engines);
}

}  // namespace

std::string help_of(const SharedOption& option) {
  std::string help;
  if (option.engines.empty())
    return fmt::format("{}{} (default {})", option.row.help, range_text(option.row),
                       option.row.default_text);
  for (std::size_t first = 0; first < option.engines.size();) {
    const OptionRow& row = option.options[first]->row;
    std::size_t end = first + 1;
    while (end < option.engines.size() && option.options[end]->row.help == row.help) ++end;
    const std::vector<const EngineEntry*> having(
        option.engines.begin() + static_cast<std::ptrdiff_t>(first),
        option.engines.begin() + static_cast<std::ptrdiff_t>(end));
    if (!help.empty()) help += ". ";
    const bool is_shared = having.size() == option.engines.size();
    help += is_shared ? capitalised(row.help) : names_of(having) + ": " + row.help;
    help += range_text(row);
    if (end == option.engines.size()) help += choices_text(option);
    help += " (" + default_text(option, first, end) + ")";
    first = end;
  }
  return help;
}

CLI::Option* add_engine_option(CLI::App& sub, OptionValues& values, const SharedOption& option) {
  const OptionRow& row = option.row;
  const std::string text = row.kind == OptionKind::Choice
                               ? fmt::format("{}", fmt::join(row.choices, "|"))
                               : row.placeholder;
  CLI::Option* const declared = sub.add_option_function<std::string>(
                                       "--" + row.key,
                                       [&values, row](const std::string& given) {
                                         if (const auto value = parse_value(row, given))
                                           values.insert_or_assign(row.key, *value);
                                       },
                                       help_of(option))
                                    ->check([row](const std::string& given) {
                                      const auto value = parse_value(row, given);
                                      return value ? std::string() : value.error().message;
                                    })
                                    ->option_text(text);
  return option.engines.empty() ? declared : declared->group(group_of(option));
}

void add_engine_options(CLI::App& sub, SceneSettings& settings,
                        std::span<const EngineEntry> among) {
  const std::vector<std::string> names = names_of(among);
  sub.add_option("--engine", settings.engine,
                 fmt::format("Engine that draws, listed below (default {})", among.front().name))
      ->check([names](const std::string& text) {
        return std::find(names.begin(), names.end(), text) != names.end()
                   ? std::string()
                   : fmt::format("expected {}; found {}", fmt::join(names, ", "), text);
      })
      ->option_text(fmt::format("{}", fmt::join(names, "|")));
  for (const SharedOption& option : shared_options(among))
    add_engine_option(sub, settings.options, option);
}

std::string list_engines(std::span<const EngineEntry> among) {
  std::size_t width = 0;
  for (const EngineEntry& engine : among) width = std::max(width, engine.name.size());
  std::string list;
  for (const EngineEntry& engine : among)
    list += fmt::format("  {:<{}} {}\n", engine.name, width, engine.summary);
  return list;
}

void check_engine_options(const SceneSettings& settings, std::span<const EngineEntry> among) {
  const EngineEntry* const engine =
      find_engine(settings.engine.value_or(among.front().name), among);
  const EngineEntry* const beside = find_engine(engine->surfaces_by, among);
  const std::vector<SharedOption> all = shared_options(among);
  for (const auto& [key, value] : settings.options) {
    const EngineOption* option = find_option(*engine, key);
    if (option == nullptr && beside != nullptr) option = find_option(*beside, key);
    if (option != nullptr) {
      if (const Status good = check_value(option->row, value); !good)
        throw CLI::ValidationError(
            "--" + key, fmt::format("engine {}: {}", engine->name, good.error().message));
      continue;
    }
    const auto shared =
        std::find_if(all.begin(), all.end(),
                     [&wanted = key](const SharedOption& o) { return o.row.key == wanted; });
    throw CLI::ValidationError("--" + key, fmt::format("engine {} does not have it, only {}",
                                                       engine->name, names_of(shared->engines)));
  }
}

}  // namespace relief::cli
