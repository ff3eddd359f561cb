#include "renderer/gl_model.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "renderer/cube_map.h"
#include "renderer/sample_draws.h"

namespace relief {
namespace {

/// A near plane that no surface that can be told apart from the eye is in front of.
double near_of(const PatchModel& model) {
  double spacing = model.spacing > 0.0 ? model.spacing : 1.0;
  for (const Patch& patch : model.patches) spacing = std::min(spacing, patch.spacing);
  return 0.01 * spacing;
}

}  // namespace

Result<std::unique_ptr<GlModel>> GlModel::create(const PatchModel& model,
                                                 std::span<const RenderSettings> views,
                                                 const StoreNeeds& needs) {
  assert(!views.empty() && "a model is prepared for at least one view");
  const RenderSettings& first = views.front();
  for (const RenderSettings& settings : views)
    assert(settings.platform == first.platform && settings.debug == first.debug);
  std::unique_ptr<GlModel> made(new GlModel);
  auto context = make_context(first.platform, first.debug);
  if (!context) return context.error();
  made->context_ = std::move(*context);
  const auto functions = load_functions(*made->context_);
  if (!functions) return functions.error();
  made->gl_ = *functions;
  if (first.debug) made->log_.emplace(made->gl_);
  auto store = upload_model(made->gl_, model, needs);
  if (!store) return store.error();
  made->store_ = std::move(*store);
  made->has_colours_ = model.has_colours;
  made->near_ = near_of(model);
  return made;
}

Result<GlPicture> GlModel::make_picture(const RenderSettings& settings) {
  const Texture* environment = nullptr;
  const Backdrop* shown = nullptr;
  const bool is_shown = !settings.environment.empty() && settings.background.has_value();
  if (is_shown || settings.material == Material::Mirror) {
    const auto found = environment_for(settings.environment);
    if (!found) return found.error();
    environment = *found;
  }
  if (is_shown) {
    const auto found = backdrop();
    if (!found) return found.error();
    shown = *found;
  }
  Result<Targets> targets = make_targets(gl_, settings.width, settings.height, settings.outputs);
  if (!targets) return targets.error();
  const View view = make_view(settings.camera, settings.width, settings.height, near_);
  const shared::Frame uniforms = make_frame(view, largest_sprite(gl_), settings.lights);
  return GlPicture{view,
                   std::move(*targets),
                   make_buffer(gl_, "frame", std::span<const shared::Frame>(&uniforms, 1)),
                   settings.background.value_or(glm::vec3(0.0F)),
                   environment,
                   shown};
}

Result<RenderResult> GlModel::draw(const GlPicture& picture, const DrawModel& draw,
                                   const DrawModel& count, const RenderSettings& settings) const {
  auto result = draw_picture(gl_, picture, draw, count, settings);
  if (result && log_ && !log_->status()) return log_->status().error();
  return result;
}

Result<const Texture*> GlModel::environment_for(const std::filesystem::path& path) {
  auto found = environments_.find(path);
  if (found == environments_.end()) {
    const Result<CubeMap> cube = load_environment(path);
    if (!cube) return cube.error();
    Result<Texture> made = upload_environment(gl_, *cube);
    if (!made) return made.error();
    found = environments_.emplace(path, std::move(*made)).first;
  }
  return &found->second;
}

Result<const Backdrop*> GlModel::backdrop() {
  if (!backdrop_) {
    Result<Backdrop> made = Backdrop::create(gl_);
    if (!made) return made.error();
    backdrop_ = std::move(*made);
  }
  return &*backdrop_;
}

}  // namespace relief
