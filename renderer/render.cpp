#include "renderer/render.h"

#include <cassert>
#include <memory>
#include <utility>
#include <vector>

#include "renderer/costs/feature_costs.h"
#include "renderer/engine_checks.h"
#include "renderer/eye_dome.h"
#include "renderer/gl/open_gl.h"
#include "renderer/shading/environment/environment_cache.h"

namespace relief {
namespace {

/// The views of one engine.
struct EngineViews {
  const EngineEntry* engine = nullptr;
  std::vector<RenderSettings> settings;
  std::vector<std::size_t> indices;  ///< in the list of all views
};

std::vector<EngineViews> group_by_engine(std::span<const RenderSettings> views,
                                         std::span<const EngineEntry> among) {
  std::vector<EngineViews> groups;
  for (const EngineEntry& engine : among) {
    EngineViews group{&engine, {}, {}};
    for (std::size_t index = 0; index < views.size(); ++index) {
      if (views[index].engine != engine.name) continue;
      group.settings.push_back(views[index]);
      group.indices.push_back(index);
    }
    if (!group.indices.empty()) groups.push_back(std::move(group));
  }
  return groups;
}

/// Draws a view, and shades it by its depth if that is asked for.
Result<RenderResult> render_view(PreparedModel& prepared, const RenderSettings& settings,
                                 Progress& progress) {
  if (settings.eye_dome == 0.0) return prepared.render(settings, progress);
  RenderSettings with_depth = settings;
  with_depth.outputs.depth = true;
  RELIEF_TRY_ASSIGN(auto result, prepared.render(with_depth, progress));
  shade_eye_dome(result.image, settings.camera, settings.eye_dome);
  if (!settings.outputs.depth)
    std::erase_if(result.image.channels, [](const Channel& c) { return c.name == "Z"; });
  return result;
}

/// An OpenGL context for these views, current from now on; null for an engine that needs none.
Result<std::shared_ptr<const OpenGl>> opengl_for(const EngineViews& views) {
  if (!views.engine->capabilities.needs_opengl) return std::shared_ptr<const OpenGl>();
  const RenderSettings& first = views.settings.front();
  for ([[maybe_unused]] const RenderSettings& settings : views.settings)
    assert(settings.platform == first.platform && settings.debug == first.debug &&
           settings.explain == first.explain);
  return OpenGl::create(first.platform, first.debug, first.explain);
}

/// Adds to an image's explanation what its features cost, if that is asked for.
Status add_costs(const RenderModel& model, const EngineViews& views, std::size_t view,
                 const std::shared_ptr<const OpenGl>& opengl,
                 const std::shared_ptr<EnvironmentCache>& environments, Progress& progress,
                 RenderResult& image) {
  const RenderSettings& settings = views.settings[view];
  const auto* const patches = model.find<PatchModel>();
  const bool can_be_measured = can_measure_costs(*views.engine) && patches != nullptr;
  if (settings.cost_turns == 0 || !image.explanation || !can_be_measured) return {};
  RELIEF_TRY_ASSIGN(image.explanation->costs, measure_feature_costs({.engine = *views.engine,
                                                                     .patches = *patches,
                                                                     .settings = settings,
                                                                     .opengl = opengl,
                                                                     .environments = environments,
                                                                     .turns = settings.cost_turns},
                                                                    progress));
  return {};
}

Status check_views(const RenderModel& model, std::span<const RenderSettings> views,
                   std::span<const EngineEntry> among) {
  for (const RenderSettings& settings : views) {
    RELIEF_TRY_ASSIGN(const EngineEntry* engine, engine_named(settings.engine, among));
    RELIEF_TRY(check_engine(*engine, settings, model, among));
  }
  return {};
}

}  // namespace

Status render_views(const RenderModel& model, std::span<const RenderSettings> views,
                    const ImageSink& sink, Progress& progress, std::span<const EngineEntry> among) {
  RELIEF_TRY(check_views(model, views, among));
  const bool several = views.size() > 1;
  progress.begin_stage("render", several ? views.size() : 0);
  QuietProgress quiet(progress);  // of several views each is one step
  const auto environments = std::make_shared<EnvironmentCache>();
  for (const EngineViews& group : group_by_engine(views, among)) {
    RELIEF_TRY_ASSIGN(const auto opengl, opengl_for(group));
    RELIEF_TRY_ASSIGN(const auto prepared, group.engine->prepare({.model = model,
                                                                  .views = group.settings,
                                                                  .opengl = opengl,
                                                                  .environments = environments}));
    for (std::size_t i = 0; i < group.settings.size(); ++i) {
      if (progress.cancelled()) return interrupted_error();
      RELIEF_TRY_ASSIGN(auto image,
                        render_view(*prepared, group.settings[i], several ? quiet : progress));
      RELIEF_TRY(
          add_costs(model, group, i, opengl, environments, several ? quiet : progress, image));
      if (progress.cancelled()) return interrupted_error();
      RELIEF_TRY(sink(group.indices[i], std::move(image)));
      if (several) progress.advance(1);
    }
  }
  return {};
}

Result<RenderResult> render(const RenderModel& model, const RenderSettings& settings,
                            Progress& progress, std::span<const EngineEntry> among) {
  RenderResult result;
  RELIEF_TRY(render_views(
      model, {&settings, 1},
      [&result](std::size_t /*view*/, RenderResult image) {
        result = std::move(image);
        return Status();
      },
      progress, among));
  return result;
}

Result<RenderResult> render(const PatchModel& patches, const RenderSettings& settings,
                            Progress& progress) {
  return render(RenderModel::of(patches), settings, progress);
}

Result<RenderResult> render(const TriangleMesh& mesh, const RenderSettings& settings,
                            Progress& progress) {
  RenderSettings traced = settings;
  traced.engine = "raytrace";
  return render(RenderModel::of(mesh), traced, progress);
}

Result<RenderResult> render(const SplatCloud& splats, const RenderSettings& settings,
                            Progress& progress) {
  RenderSettings splatted = settings;
  splatted.engine = "ewa";
  return render(RenderModel::of(splats), splatted, progress);
}

}  // namespace relief
