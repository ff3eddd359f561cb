#include "cli/bench/bench_plan.h"

#include <algorithm>
#include <utility>

#include "cli/bench/bench_engines.h"
#include "loader/load_scene.h"
#include "renderer/engine_checks.h"
#include "renderer/shading/materials.h"

namespace relief::cli {
namespace {

void add(const RenderModel& model, const RenderSettings& row, std::optional<double> value,
         BenchPlan& plan) {
  plan.job.rows.push_back({model, row});
  plan.result.rows.push_back(row);
  plan.result.swept_values.push_back(value);
  const bool draws_points = form_for(*find_engine(row.engine), model) == ModelForm::Splats;
  const auto* const points = draws_points ? model.find<SplatCloud>() : nullptr;
  plan.result.inputs.push_back(draws_points ? BenchInput::Points : BenchInput::Samples);
  plan.result.samples.push_back(points != nullptr ? points->positions.size()
                                                  : count_samples(*model.find<PatchModel>()));
}

Status add_methods(const BenchModels& models, const BenchView& view,
                   const std::optional<Sweep>& sweep, BenchPlan& plan) {
  const RenderModel usual = RenderModel::of(models.scene.patches);
  RELIEF_TRY_ASSIGN(const auto rows, sweep ? compared_rows(view) : bench_rows(view));
  for (const RenderSettings& row : rows) add(usual, row, std::nullopt, plan);
  if (sweep) plan.result.swept = sweep->key;
  if (sweep && !converts(*sweep)) {
    RELIEF_TRY_ASSIGN(const auto swept, swept_rows(view, sweep->key, sweep->values));
    for (const RenderSettings& row : swept) add(usual, row, std::nullopt, plan);
  }
  for (std::size_t k = 0; k < models.swept.size(); ++k)
    add(RenderModel::of(models.swept[k]), rows.front(), sweep->values[k], plan);
  plan.result.reference = find_default(plan.result.rows);
  plan.job.reference = plan.result.reference;
  return {};
}

/// The row whose pixels the bound shades: the default, or else the first that draws patches with
/// OpenGL.
std::optional<std::size_t> find_reference(const BenchResult& result) {
  const auto& rows = result.rows;
  auto found = std::find_if(rows.begin(), rows.end(), is_default);
  for (auto row = rows.begin(); found == rows.end() && row != rows.end(); ++row) {
    const auto k = static_cast<std::size_t>(row - rows.begin());
    if (needs_opengl(row->engine) && result.inputs[k] == BenchInput::Samples) found = row;
  }
  if (found == rows.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows.begin());
}

Status add_engines(const BenchModels& models, const BenchView& view,
                   const std::vector<const EngineEntry*>& engines, BenchPlan& plan) {
  RenderModel model = RenderModel::of(models.scene.patches);
  if (models.scene.splats) model.add(*models.scene.splats);
  RELIEF_TRY_ASSIGN(const auto rows, engine_rows(view, engines));
  for (const RenderSettings& row : rows) add(model, row, std::nullopt, plan);
  plan.result.compares_engines = true;
  plan.job.reference = find_reference(plan.result);
  plan.result.reference = plan.job.reference.value_or(0);
  return {};
}

/// Before anything is timed.
Status check_materials(const BenchJob& job) {
  const RenderSettings& base = job.rows.front().settings;
  if (uses(base, Material::Split)) {
    return make_error(
        "the material split is for relief render: most rows of relief bench can't show it; take "
        "lit "
        "or mirror");
  }
  if (has_two_interfaces(base)) {
    return make_error(
        "glass with two interfaces is for relief render: most rows of relief bench can't show it; "
        "take --interfaces 1");
  }
  for (const BenchMethod& row : job.rows)
    RELIEF_TRY(check_engine(*find_engine(row.settings.engine), row.settings, row.model));
  return {};
}

}  // namespace

Result<BenchModels> load_for_bench(const ScenePlan& plan, const BenchChoice& choice,
                                   Progress& progress) {
  const FormNeeds needs{.patches = true, .splats = draw_points(choice.engines), .mesh = true};
  RELIEF_TRY_ASSIGN(auto scene, load_models(plan.models, {}, needs, progress));
  BenchModels models{std::move(scene), {}};
  if (!choice.sweep || !converts(*choice.sweep)) return models;
  RELIEF_TRY_ASSIGN(auto swept, convert_sweep(plan.models.front().file, *choice.sweep, progress));
  models.swept = std::move(swept);
  return models;
}

Result<BenchPlan> plan_bench(const BenchModels& models, const BenchView& view,
                             const BenchChoice& choice) {
  BenchPlan plan;
  RELIEF_TRY(choice.engines.empty() ? add_methods(models, view, choice.sweep, plan)
                                    : add_engines(models, view, choice.engines, plan));
  RELIEF_TRY(check_materials(plan.job));
  plan.result.truth_is_input = models.scene.mesh_is_input;
  if (models.scene.mesh_is_input) {
    plan.job.mesh = &*models.scene.mesh;
    plan.result.mesh_triangles = models.scene.mesh->triangles.size();
  }
  return plan;
}

}  // namespace relief::cli
