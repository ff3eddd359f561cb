// From what the user asks of `relief bench` to what is timed.
#pragma once

#include <optional>
#include <vector>

#include "cli/bench/bench_rows.h"
#include "cli/bench/bench_sweep.h"
#include "cli/reports/bench_report.h"
#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "loader/scene/loaded_scene.h"
#include "loader/scene/scene_plan.h"
#include "renderer/bench/bench.h"
#include "renderer/engine_registry.h"

namespace relief::cli {

/// Which rows there are: of --sweep, of --engines, or by default every method of the engines on
/// OpenGL.
struct BenchChoice {
  std::optional<Sweep> sweep;
  std::vector<const EngineEntry*> engines;  ///< empty without --engines
};

/// What the rows draw.
struct BenchModels {
  LoadedScene scene;              ///< converted with the default options
  std::vector<PatchModel> swept;  ///< of a sweep that converts, by its values
};

/// Reads the scene in the forms that the rows draw, and the mesh that they are compared with.
Result<BenchModels> load_for_bench(const ScenePlan& plan, const BenchChoice& choice,
                                   Progress& progress);

/// The rows to draw, and the result that measurements complete.
struct BenchPlan {
  BenchJob job;
  BenchResult result;
};

/// Fails if an engine can't draw the view's materials. `models` outlive the plan.
Result<BenchPlan> plan_bench(const BenchModels& models, const BenchView& view,
                             const BenchChoice& choice);

}  // namespace relief::cli
