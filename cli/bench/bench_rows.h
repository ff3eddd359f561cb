// The rows of `relief bench`: the engines' variants, as their entries list them.
#pragma once

#include <string>
#include <vector>

#include "common/error.h"
#include "loader/scene/scene_plan.h"
#include "renderer/engine_registry.h"

namespace relief::cli {

/// The engine that ratios of times refer to.
inline constexpr const char* kRivalEngine = "multipass";

/// The settings that all rows share: the camera, size and material of a view.
struct BenchView {
  const ScenePlan& plan;
  const PlannedView& view;
  const PatchModel& extent;
  GlPlatform platform = GlPlatform::Automatic;
};

/// Returns a row: the view drawn by the engine with these option values. Options that the engine's
/// variants choose and that `values` lacks are at their defaults; the other options are the view's.
/// Outputs are colour only, without a background, which would cost all rows the same.
Result<RenderSettings> bench_row(const BenchView& view, const EngineEntry& engine,
                                 const OptionValues& values);

/// The bench variants of all engines, each engine followed by a row for each number that the view
/// sets and no variant has.
Result<std::vector<RenderSettings>> bench_rows(const BenchView& view);

/// Returns the default row of `relief render`, and kRivalEngine with its defaults.
Result<std::vector<RenderSettings>> compared_rows(const BenchView& view);

/// The first engine on OpenGL that has the option, with each of the values.
Result<std::vector<RenderSettings>> swept_rows(const BenchView& view, const std::string& key,
                                               const std::vector<double>& values);

/// The name of a row: its engine and what its variants choose, "onepass cell corrected
/// pixels-per-sample 4", and "clipped" if it is.
[[nodiscard]] std::string name_of_row(const RenderSettings& row);

/// The same without numbers that are the engine's defaults: "onepass cell corrected".
[[nodiscard]] std::string short_name_of_row(const RenderSettings& row);

/// Returns whether the numbers that a row's variants choose are those of its engine's defaults.
[[nodiscard]] bool has_default_numbers(const RenderSettings& row);

/// Returns whether a row has the defaults of `relief render`.
[[nodiscard]] bool is_default(const RenderSettings& row);

/// The first row that is the default; there is one.
[[nodiscard]] std::size_t find_default(const std::vector<RenderSettings>& rows);

}  // namespace relief::cli
