// Options of engines: declared, described and checked by the engines' own tables.
#pragma once

#include <CLI/App.hpp>
#include <span>
#include <string>

#include "common/scene/scene.h"
#include "renderer/engine_registry.h"

namespace relief::cli {

/// Declares --engine, and the option of each key that an engine has. `among` must outlive `sub`.
void add_engine_options(CLI::App& sub, SceneSettings& settings,
                        std::span<const EngineEntry> among = engines());

/// Declares the option of one key, in the group of options that the same engines have. One of no
/// engine has the help of its row.
CLI::Option* add_engine_option(CLI::App& sub, OptionValues& values, const SharedOption& option);

/// Returns the help of an option: its effect, its range, its default; with the engines before it
/// where their options of that key differ.
[[nodiscard]] std::string help_of(const SharedOption& option);

/// One line an engine: its name and summary.
[[nodiscard]] std::string list_engines(std::span<const EngineEntry> among = engines());

/// Throws CLI::ValidationError unless the engine of the settings has all their options and accepts
/// their values.
void check_engine_options(const SceneSettings& settings,
                          std::span<const EngineEntry> among = engines());

}  // namespace relief::cli
