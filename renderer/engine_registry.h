// The engines that there are, and what follows from their entries.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/error.h"
#include "common/scene/option.h"
#include "renderer/engine.h"

namespace relief {

/// The engines of this version, the default one first. The list lives as long as the process.
[[nodiscard]] std::span<const EngineEntry> engines();

/// The engine of that name, or null.
[[nodiscard]] const EngineEntry* find_engine(std::string_view name,
                                             std::span<const EngineEntry> among = engines());

/// The engine of that name. Fails if there is none, with the names that there are.
Result<const EngineEntry*> engine_named(std::string_view name,
                                        std::span<const EngineEntry> among = engines());

/// Whether the engine of that name draws with OpenGL; false if there is none.
[[nodiscard]] bool needs_opengl(std::string_view name);

/// Settings of the engine's own defaults: its name, and the first of its primitives and
/// interpolations.
[[nodiscard]] RenderSettings default_settings(const EngineEntry& engine);

/// The engine's option of that key, or null.
[[nodiscard]] const EngineOption* find_option(const EngineEntry& engine, std::string_view key);

/// Puts the values where the engine reads them. Fails if the engine has no such option, or the
/// option does not accept its value.
Status apply_options(const EngineEntry& engine, const OptionValues& values,
                     RenderSettings& settings);

/// A key with all engines that have it, for `--help` and scene files.
struct SharedOption {
  OptionRow row;  ///< accepts what any of the engines does; help and default of the first
  std::vector<const EngineEntry*> engines;
  std::vector<const EngineOption*> options;  ///< theirs, parallel to `engines`
};

/// The options of all engines, each key once, in the order of the registry.
[[nodiscard]] std::vector<SharedOption> shared_options(
    std::span<const EngineEntry> among = engines());

/// The form of the model that the engine draws: the first of its forms that the model has; none if
/// it has none of them.
[[nodiscard]] std::optional<ModelForm> form_for(const EngineEntry& engine,
                                                const RenderModel& model);

}  // namespace relief
