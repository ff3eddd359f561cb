#include "renderer/frame/gl_model.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "renderer/frame/sample_draws.h"
#include "renderer/geometry/proxy/proxy.h"
#include "renderer/shading/environment/cube_map.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/shading/environment/rough_environment.h"
#include "renderer/shading/environment/standing_cube.h"
#include "renderer/shading/materials.h"
#include "renderer/view/cull_mode.h"
#include "renderer/view/uniforms.h"

namespace relief {
namespace {

// The near plane's distance, in finest spacings. Single precision tells points of a patch of 64
// samples apart at 4e-6 of them; with reversed depth so small a distance costs no precision.
constexpr double kNearSpacings = 1e-6;

/// A near plane that no surface that can be told apart from the eye is in front of, and the
/// coarsest samples.
DepthNeeds depth_needs_of(const PatchModel& model) {
  double finest = model.spacing > 0.0 ? model.spacing : 1.0;
  double coarsest = model.spacing;
  const auto note = [&](double spacing) {
    finest = std::min(finest, spacing);
    coarsest = std::max(coarsest, spacing);
  };
  if (model.instances.empty()) {
    for (const Patch& patch : model.patches) note(patch.spacing);
  }
  for (const Instance& instance : model.instances) {
    for (std::uint32_t k = 0; k < instance.count; ++k)
      note(instance.transform.scale * model.patches[instance.first + k].spacing);
  }
  return {kNearSpacings * finest, model.bounds, coarsest};
}

View view_of(const RenderSettings& settings, const DepthNeeds& depth_needs) {
  View view = make_view(settings.camera, settings.width, settings.height, depth_needs);
  view.pixels_per_sample = pixels_per_sample_of(settings);
  view.proxy_diameter = draws_from_afar(settings) ? settings.afar_factor * kProxyDiameter : 0.0;
  view.cull = cull_mode_of(settings);
  return view;
}

}  // namespace

Result<std::unique_ptr<GlModel>> GlModel::create(GlModelParts parts) {
  std::unique_ptr<GlModel> made(new GlModel);
  made->opengl_ = std::move(parts.opengl);
  made->cubes_ = std::move(parts.environments);
  made->maps_ = ModelMaps(parts.patches);
  made->depth_needs_ = depth_needs_of(parts.patches);
  made->pool_ = parts.pool;
  if (parts.pool != nullptr) {
    made->depth_needs_.bounds = parts.pool->body().box;
    return made;
  }
  StoreOrder order = order_for(parts.patches, parts.views, parts.needs, parts.levels);
  // A look may have changed since it was collected for.
  if (parts.collected != nullptr && parts.collected->serves(order)) {
    RELIEF_TRY_ASSIGN(made->store_, parts.collected->upload(made->gl()));
    return made;
  }
  RELIEF_TRY_ASSIGN(const auto collected, CollectedStore::collect(store_limits(made->gl()),
                                                                  parts.patches, std::move(order)));
  RELIEF_TRY_ASSIGN(made->store_, collected->upload(made->gl()));
  return made;
}

StoreOrder GlModel::order_for(const PatchModel& model, std::span<const RenderSettings> views,
                              const StoreNeeds& needs, KeptLevels levels) {
  StoreOrder order{needs, {}, levels == KeptLevels::All};
  const DepthNeeds depth_needs = depth_needs_of(model);
  for (const RenderSettings& settings : views)
    order.views.push_back(relief::view_of(settings, depth_needs));
  return order;
}

Result<GlFrame> GlModel::make_frame(const RenderSettings& settings, const Raster& part,
                                    std::optional<Targets> targets) {
  if (!targets) {
    RELIEF_TRY_ASSIGN(targets, make_targets(gl(), part.width * part.side, part.height * part.side,
                                            settings.outputs));
  }
  const View view = view_of_part(view_of(settings), part);
  shared::Frame uniforms = relief::make_frame(view, largest_sprite(gl()), settings.lights);
  if (settings.lights.from_environment) {
    RELIEF_TRY_ASSIGN(const auto irradiance, cubes_->irradiance(settings.environment));
    std::ranges::copy(irradiance, uniforms.irradiance);
  }
  set_environment(uniforms, environment_from_world(settings));
  uniforms.material = info_of(materials_of(settings).front(), {});
  GlFrame frame{
      .view = view,
      .targets = *std::move(targets),
      .uniforms = make_buffer(gl(), "frame", std::span<const shared::Frame>(&uniforms, 1)),
      .background = settings.background.value_or(glm::vec3(0.0F))};
  RELIEF_TRY(add_materials(settings, frame));
  if (!has_backdrop(settings)) return frame;
  RELIEF_TRY_ASSIGN(frame.surroundings, environment_for(settings.environment, 0.0F));
  RELIEF_TRY_ASSIGN(frame.backdrop, backdrop(settings));
  return frame;
}

Status GlModel::add_materials(const RenderSettings& settings, GlFrame& frame) {
  const std::vector<MaterialSettings> materials = materials_of(settings);
  const bool mixed = materials.size() > 1;
  if (reflects(settings)) {
    const float roughness = mixed ? 0.0F : roughness_of(materials.front());
    RELIEF_TRY_ASSIGN(const auto environment, environment_for(settings.environment, roughness));
    frame.environment = environment;
  }
  if (!mixed) return {};
  const std::vector<float> roughnesses = roughnesses_of(materials);
  if (!roughnesses.empty()) {
    RELIEF_TRY_ASSIGN(const auto environments,
                      rough_environments_for(settings.environment, roughnesses));
    frame.rough_environments = environments;
  }
  std::vector<shared::MaterialInfo> infos;
  infos.reserve(kMaxMaterials);
  for (const MaterialSettings& material : materials)
    infos.push_back(info_of(material, roughnesses));
  infos.resize(kMaxMaterials);  // the whole block, as the shader declares it
  frame.materials = make_buffer(gl(), "materials", std::span<const shared::MaterialInfo>(infos));
  return {};
}

View GlModel::view_of(const RenderSettings& settings) const {
  return relief::view_of(settings, depth_needs_);
}

Result<const Texture*> GlModel::environment_for(const std::filesystem::path& path,
                                                float roughness) {
  auto found = environments_.find({path, roughness});
  if (found == environments_.end()) {
    RELIEF_TRY_ASSIGN(const CubeMap* cube, cubes_->get(path, roughness));
    RELIEF_TRY_ASSIGN(Texture made, upload_environment(gl(), *cube));
    found = environments_.emplace(std::pair(path, roughness), std::move(made)).first;
  }
  return &found->second;
}

Result<const Texture*> GlModel::rough_environments_for(const std::filesystem::path& path,
                                                       const std::vector<float>& roughnesses) {
  auto found = rough_environments_.find({path, roughnesses});
  if (found == rough_environments_.end()) {
    RELIEF_TRY_ASSIGN(const CubeMap* smooth, cubes_->get(path));
    std::uint32_t size = 1;
    for (const float roughness : roughnesses) size = std::max(size, rough_size(*smooth, roughness));
    std::vector<CubeMap> cubes;
    cubes.reserve(roughnesses.size());
    for (const float roughness : roughnesses) cubes.push_back(prefilter(*smooth, roughness, size));
    RELIEF_TRY_ASSIGN(Texture made, upload_environments(gl(), cubes));
    found = rough_environments_.emplace(std::pair(path, roughnesses), std::move(made)).first;
  }
  return &found->second;
}

Result<const Resolve*> GlModel::resolve() {
  if (!resolve_) {
    RELIEF_TRY_ASSIGN(Resolve made, Resolve::create(gl()));
    resolve_ = std::move(made);
  }
  return &*resolve_;
}

Result<const Backdrop*> GlModel::backdrop(const RenderSettings& settings) {
  const bool orthographic = settings.camera.is_orthographic();
  auto found = backdrops_.find(orthographic);
  if (found == backdrops_.end()) {
    RELIEF_TRY_ASSIGN(Backdrop made,
                      Backdrop::create(gl(), orthographic ? RELIEF_FEATURE_ORTHOGRAPHIC : 0U));
    found = backdrops_.emplace(orthographic, std::move(made)).first;
  }
  return &found->second;
}

}  // namespace relief
