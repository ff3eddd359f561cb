// The presets of --quality: options that are taken where the user gives none.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <cstdint>
#include <optional>

#include "common/patch_file/patch_file.h"
#include "common/scene/choices.h"
#include "common/scene/option.h"
#include "loader/scene/scene_plan.h"
#include "preprocess/convert_options.h"

namespace relief::cli {

enum class Quality : std::uint8_t { Draft, Balanced, Exact };

inline constexpr std::array<Named<Quality>, 3> kQualities{
    {{"draft", Quality::Draft}, {"balanced", Quality::Balanced}, {"exact", Quality::Exact}}};

/// Options by their names without dashes. Empty: all defaults.
struct QualityPreset {
  OptionValues convert;  ///< of `relief convert`
  OptionValues render;   ///< of `relief render` with the default engine
};

/// The options that a preset stands for; docs/trade.md has the measurements that they follow from.
[[nodiscard]] QualityPreset preset_of(Quality quality);

/// Puts values of `relief convert` where a conversion and a file read them. Keys are those of the
/// presets and of `relief bench --trade`.
void set_conversion(const OptionValues& values, ConvertOptions& options, PatchFileOptions& file);

/// Declares --quality, which fills `quality`. It must outlive `sub`.
void add_quality_option(CLI::App& sub, std::optional<Quality>& quality);

/// The preset's values of `relief convert` whose options, and those that say the same otherwise,
/// are not on the command line of `sub`.
[[nodiscard]] OptionValues values_not_given(const OptionValues& preset, const CLI::App& sub);

/// Gives the views that the default engine draws the preset's options which neither the scene nor
/// the command line sets. Others stay as they are.
void complete_views(const OptionValues& preset, ScenePlan& plan);

}  // namespace relief::cli
