// `relief bench --engines`: which engines are compared, and their rows.
#pragma once

#include <string>
#include <vector>

#include "cli/bench/bench_rows.h"
#include "common/error.h"
#include "renderer/engine_registry.h"

namespace relief::cli {

/// The engines that can be compared: those that draw surfaces from patches or points.
[[nodiscard]] std::vector<const EngineEntry*> comparable_engines();

/// "all", or names of comparable engines, separated by commas; in the registry's order, each once.
/// Throws CLI::ValidationError.
[[nodiscard]] std::vector<const EngineEntry*> parse_engines(const std::string& text);

/// Returns whether one of the engines prefers to draw the points of a scan.
[[nodiscard]] bool draw_points(const std::vector<const EngineEntry*>& engines);

/// The variants that stand for each engine, each followed by itself clipped at sharp edges if the
/// engine clips splats.
Result<std::vector<RenderSettings>> engine_rows(const BenchView& view,
                                                const std::vector<const EngineEntry*>& engines);

}  // namespace relief::cli
