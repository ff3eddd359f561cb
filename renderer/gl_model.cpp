#include "renderer/gl_model.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

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

Result<std::unique_ptr<GlModel>> GlModel::create(std::shared_ptr<const OpenGl> opengl,
                                                 const PatchModel& model,
                                                 std::span<const RenderSettings> views,
                                                 const StoreNeeds& needs) {
  std::unique_ptr<GlModel> made(new GlModel);
  made->opengl_ = std::move(opengl);
  made->has_colours_ = model.has_colours;
  made->near_ = near_of(model);
  std::vector<View> looks;
  looks.reserve(views.size());
  for (const RenderSettings& settings : views) looks.push_back(made->view_of(settings));
  auto store = upload_model(made->gl(), model, needs, looks);
  if (!store) return store.error();
  made->store_ = std::move(*store);
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
  Result<Targets> targets = make_targets(gl(), settings.width, settings.height, settings.outputs);
  if (!targets) return targets.error();
  const View view = view_of(settings);
  const shared::Frame uniforms = make_frame(view, largest_sprite(gl()));
  return GlPicture{view,
                   std::move(*targets),
                   make_buffer(gl(), "frame", std::span<const shared::Frame>(&uniforms, 1)),
                   settings.background.value_or(glm::vec3(0.0F)),
                   environment,
                   shown};
}

View GlModel::view_of(const RenderSettings& settings) const {
  View view = make_view(settings.camera, settings.width, settings.height, near_);
  view.pixels_per_sample = settings.pixels_per_sample;
  return view;
}

Result<RenderResult> GlModel::draw(const GlDrawing& drawing, const RenderSettings& settings) const {
  auto result = draw_picture(gl(), drawing, settings);
  if (!result) return result;
  const Status good = opengl_->status();
  if (!good) return good.error();
  return result;
}

Result<const Texture*> GlModel::environment_for(const std::filesystem::path& path) {
  auto found = environments_.find(path);
  if (found == environments_.end()) {
    const Result<CubeMap> cube = load_environment(path);
    if (!cube) return cube.error();
    Result<Texture> made = upload_environment(gl(), *cube);
    if (!made) return made.error();
    found = environments_.emplace(path, std::move(*made)).first;
  }
  return &found->second;
}

Result<const Backdrop*> GlModel::backdrop() {
  if (!backdrop_) {
    Result<Backdrop> made = Backdrop::create(gl());
    if (!made) return made.error();
    backdrop_ = std::move(*made);
  }
  return &*backdrop_;
}

}  // namespace relief
