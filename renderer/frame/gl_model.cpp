#include "renderer/frame/gl_model.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "renderer/frame/sample_draws.h"
#include "renderer/geometry/proxy.h"
#include "renderer/shading/cube_map.h"
#include "renderer/shading/environment_cache.h"
#include "renderer/shading/materials.h"
#include "renderer/shading/rough_environment.h"
#include "renderer/view/cull_mode.h"

namespace relief {
namespace {

/// A near plane that no surface that can be told apart from the eye is in front of, and the
/// coarsest samples.
DepthNeeds depth_needs_of(const PatchModel& model) {
  double finest = model.spacing > 0.0 ? model.spacing : 1.0;
  double coarsest = model.spacing;
  const auto note = [&](double spacing) {
    finest = std::min(finest, spacing);
    coarsest = std::max(coarsest, spacing);
  };
  if (model.placements.empty()) {
    for (const Patch& patch : model.patches) note(patch.spacing);
  }
  for (const Placement& placement : model.placements) {
    for (std::uint32_t k = 0; k < placement.count; ++k)
      note(placement.transform.scale * model.patches[placement.first + k].spacing);
  }
  return {0.01 * finest, model.bounds, coarsest};
}

}  // namespace

Result<std::unique_ptr<GlModel>> GlModel::create(std::shared_ptr<const OpenGl> opengl,
                                                 const PatchModel& model,
                                                 std::span<const RenderSettings> views,
                                                 const StoreNeeds& needs) {
  std::unique_ptr<GlModel> made(new GlModel);
  made->opengl_ = std::move(opengl);
  made->maps_ = ModelMaps(model);
  made->depth_needs_ = depth_needs_of(model);
  std::vector<View> looks;
  looks.reserve(views.size());
  for (const RenderSettings& settings : views) looks.push_back(made->view_of(settings));
  auto store = upload_model(made->gl(), model, needs, looks);
  if (!store) return store.error();
  made->store_ = std::move(*store);
  return made;
}

Result<GlPicture> GlModel::make_picture(const RenderSettings& settings, const Raster& part) {
  Result<Targets> targets =
      make_targets(gl(), part.width * part.side, part.height * part.side, settings.outputs);
  if (!targets) return targets.error();
  const View view = view_of_part(view_of(settings), part);
  shared::Frame uniforms = make_frame(view, largest_sprite(gl()), settings.lights);
  uniforms.material = info_of(materials_of(settings).front(), {});
  GlPicture picture{view,
                    std::move(*targets),
                    make_buffer(gl(), "frame", std::span<const shared::Frame>(&uniforms, 1)),
                    settings.background.value_or(glm::vec3(0.0F)),
                    nullptr,
                    nullptr,
                    std::nullopt,
                    nullptr,
                    nullptr,
                    std::nullopt};
  const Status added = add_materials(settings, picture);
  if (!added) return added.error();
  if (settings.environment.empty() || !settings.background) return picture;
  const auto surroundings = environment_for(settings.environment, 0.0F);
  if (!surroundings) return surroundings.error();
  const auto shown = backdrop(settings);
  if (!shown) return shown.error();
  picture.surroundings = *surroundings;
  picture.backdrop = *shown;
  return picture;
}

Status GlModel::add_materials(const RenderSettings& settings, GlPicture& picture) {
  const std::vector<MaterialSettings> materials = materials_of(settings);
  const bool mixed = materials.size() > 1;
  if (reflects(settings)) {
    const float roughness = mixed ? 0.0F : roughness_of(materials.front());
    const auto environment = environment_for(settings.environment, roughness);
    if (!environment) return environment.error();
    picture.environment = *environment;
  }
  if (!mixed) return {};
  const std::vector<float> roughnesses = roughnesses_of(materials);
  if (!roughnesses.empty()) {
    const auto environments = rough_environments_for(settings.environment, roughnesses);
    if (!environments) return environments.error();
    picture.rough_environments = *environments;
  }
  std::vector<shared::MaterialInfo> infos;
  infos.reserve(kMaxMaterials);
  for (const MaterialSettings& material : materials)
    infos.push_back(info_of(material, roughnesses));
  infos.resize(kMaxMaterials);  // the whole block, as the shader declares it
  picture.materials = make_buffer(gl(), "materials", std::span<const shared::MaterialInfo>(infos));
  return {};
}

View GlModel::view_of(const RenderSettings& settings) const {
  View view = make_view(settings.camera, settings.width, settings.height, depth_needs_);
  view.pixels_per_sample = pixels_per_sample_of(settings);
  view.far_diameter = draws_from_afar(settings) ? kFarDiameter : 0.0;
  view.sides = sides_of(settings);
  return view;
}

Result<RenderResult> GlModel::draw(const GlDrawing& drawing, const RenderSettings& settings) const {
  auto result = draw_picture(gl(), drawing, settings);
  if (!result) return result;
  const Status good = opengl_->status();
  if (!good) return good.error();
  return result;
}

Result<const Texture*> GlModel::environment_for(const std::filesystem::path& path,
                                                float roughness) {
  auto found = environments_.find({path, roughness});
  if (found == environments_.end()) {
    EnvironmentCache cubes;
    const Result<const CubeMap*> cube = cubes.get(path, roughness);
    if (!cube) return cube.error();
    Result<Texture> made = upload_environment(gl(), **cube);
    if (!made) return made.error();
    found = environments_.emplace(std::pair(path, roughness), std::move(*made)).first;
  }
  return &found->second;
}

Result<const Texture*> GlModel::rough_environments_for(const std::filesystem::path& path,
                                                       const std::vector<float>& roughnesses) {
  auto found = rough_environments_.find({path, roughnesses});
  if (found == rough_environments_.end()) {
    const Result<CubeMap> smooth = load_environment(path);
    if (!smooth) return smooth.error();
    std::uint32_t size = 1;
    for (const float roughness : roughnesses) size = std::max(size, rough_size(*smooth, roughness));
    std::vector<CubeMap> cubes;
    cubes.reserve(roughnesses.size());
    for (const float roughness : roughnesses) cubes.push_back(prefilter(*smooth, roughness, size));
    Result<Texture> made = upload_environments(gl(), cubes);
    if (!made) return made.error();
    found = rough_environments_.emplace(std::pair(path, roughnesses), std::move(*made)).first;
  }
  return &found->second;
}

Result<const Resolve*> GlModel::resolve() {
  if (!resolve_) {
    Result<Resolve> made = Resolve::create(gl());
    if (!made) return made.error();
    resolve_ = std::move(*made);
  }
  return &*resolve_;
}

Result<const Backdrop*> GlModel::backdrop(const RenderSettings& settings) {
  const bool orthographic = settings.camera.is_orthographic();
  auto found = backdrops_.find(orthographic);
  if (found == backdrops_.end()) {
    Result<Backdrop> made = Backdrop::create(gl(), orthographic ? RELIEF_FEATURE_ORTHOGRAPHIC : 0U);
    if (!made) return made.error();
    found = backdrops_.emplace(orthographic, std::move(*made)).first;
  }
  return &found->second;
}

}  // namespace relief
