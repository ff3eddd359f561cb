#include "renderer/volume/volume_model.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <glm/geometric.hpp>
#include <utility>
#include <variant>

#include "common/image/srgb.h"
#include "common/volume/transfer_function.h"
#include "renderer/shading/materials.h"
#include "renderer/shading/shading.h"
#include "renderer/volume/coarse_kernels.h"
#include "renderer/volume/extent.h"
#include "renderer/volume/kernels/clip_kernels.h"
#include "renderer/volume/kernels/gaussian_kernels.h"
#include "renderer/volume/kernels/volume_kernels.h"

namespace relief {

namespace {

const VolumeSettings& settings_of(const RenderSettings& settings, std::size_t index) {
  return index < settings.volumes.size() ? settings.volumes[index] : settings.volume;
}

/// A part's material in an image that has but one, too.
std::size_t material_within(std::size_t own, std::size_t count) {
  return own < count ? own : 0;
}

}  // namespace

VolumeModel::VolumeModel(const RenderModel& model) {
  if (const auto* const parts = model.find<VolumeParts>()) {
    for (const VolumePart& part : parts->list) {
      parts_.push_back({std::get_if<ScalarVolume>(&part.what),
                        std::get_if<GaussianCloud>(&part.what), part.material, part.settings});
    }
  } else {
    parts_.push_back({model.find<ScalarVolume>(), model.find<GaussianCloud>()});
  }
  for ([[maybe_unused]] const Part& part : parts_)
    assert((part.volume != nullptr || part.gaussians != nullptr) && "one of the two");
}

bool VolumeModel::has_volume() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part& part) { return part.volume != nullptr; });
}

double VolumeModel::spacing() const {
  double finest = 0.0;
  for (const Part& part : parts_) {
    if (part.volume == nullptr) continue;
    const double own = mean_spacing(*part.volume);
    finest = finest > 0.0 ? std::min(finest, own) : own;
  }
  return finest;
}

RenderSettings VolumeModel::settled(RenderSettings settings) const {
  if (parts_.size() > 1) return settings;
  settings.volume = VolumeSettings(settings_of(settings, parts_.front().settings));
  settings.volumes.clear();
  return settings;
}

Result<KernelCloud> VolumeModel::kernels_of(const Part& part, const VolumeSettings& chosen,
                                            const Progress& progress) const {
  if (part.gaussians != nullptr) return kernels_of_gaussians(*part.gaussians);
  RELIEF_TRY_ASSIGN(const TransferFunction function,
                    transfer_function_for(chosen.transfer, *part.volume));
  return kernels_of_volume(*part.volume, function, chosen, progress);
}

Result<const KernelCloud*> VolumeModel::kernels(const RenderSettings& settings,
                                                const Progress& progress) {
  std::vector<Key> keys(parts_.size());
  bool has_gaussians = false;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const VolumeSettings& chosen = settings_of(settings, parts_[p].settings);
    has_gaussians |= parts_[p].gaussians != nullptr;
    keys[p].clip = settings.volume.clip;
    if (parts_[p].volume == nullptr) continue;
    keys[p] = {chosen.transfer, chosen.kernel_sigma, chosen.iso, chosen.iso_opacity,
               settings.volume.clip};
  }
  if (has_gaussians && has_volume() && settings.volume.attenuation == Attenuation::Exponential) {
    return make_error(
        "3D Gaussians have opacities, which are no optical depths: beside a volume take "
        "--attenuation linear");
  }
  // A level is that of the whole model: of one volume.
  const int level = level_for(settings);
  keys.front().level = level;
  if (level > 0) keys.front().attenuation = settings.volume.attenuation;
  if (keys_ == keys) return &kernels_;
  RELIEF_TRY_ASSIGN(const auto box, clip_box(settings));
  keys_.reset();
  ++version_;
  std::vector<KernelCloud> clouds;
  for (const Part& part : parts_) {
    RELIEF_TRY_ASSIGN(auto cloud, kernels_of(part, settings_of(settings, part.settings), progress));
    if (progress.cancelled()) return interrupted_error();
    if (box) clip_kernels(cloud, *box);
    clouds.push_back(std::move(cloud));
  }
  kernels_ = merged(std::move(clouds));
  if (const ScalarVolume* const single = volume(); single != nullptr && level > 0) {
    kernels_ = coarse_kernels(std::move(kernels_), std::get<RegularGrid>(single->placement), level,
                              settings.volume.attenuation);
  }
  keys_ = std::move(keys);
  return &kernels_;
}

int VolumeModel::level_for(const RenderSettings& settings) const {
  const VolumeSettings& chosen = settings.volume;
  if (chosen.pixels_per_node <= 0.0 || volume() == nullptr || chosen.iso) return 0;
  const auto* const grid = std::get_if<RegularGrid>(&volume()->placement);
  if (grid == nullptr) return 0;
  return coarse_level(*volume(), *grid, volume_view(settings), chosen.pixels_per_node);
}

Result<std::optional<Bounds>> VolumeModel::clip_box(const RenderSettings& settings) const {
  if (!settings.volume.clip) return std::optional<Bounds>();
  std::vector<glm::dvec3> extent;
  for (const Part& part : parts_) {
    const std::vector<glm::dvec3> own =
        part.gaussians != nullptr ? extent_of(*part.gaussians) : extent_of(*part.volume);
    extent.insert(extent.end(), own.begin(), own.end());
  }
  if (extent.empty()) return std::optional<Bounds>();  // a scene without Gaussians
  RELIEF_TRY_ASSIGN(const Bounds box, place_clip_box(*settings.volume.clip, bounds_of(extent)));
  return std::optional(box);
}

std::vector<FootprintRule> VolumeModel::footprint_rules(const RenderSettings& settings,
                                                        const View& view) const {
  std::vector<FootprintRule> rules;
  rules.reserve(parts_.size());
  for (const Part& part : parts_) {
    const bool is_peak = part.gaussians != nullptr;
    rules.push_back(footprint_rule(settings.volume,
                                   is_peak ? KernelWeight::Peak : KernelWeight::Integral,
                                   is_peak && part.gaussians->is_antialiased, view));
  }
  return rules;
}

Result<KernelColour> VolumeModel::colour_of_part(const Part& part, const KernelCloud& kernels,
                                                 std::size_t first, const RenderSettings& settings,
                                                 const View& view,
                                                 EnvironmentCache& environments) const {
  const VolumeSettings& chosen = settings_of(settings, part.settings);
  if (part.gaussians != nullptr) {
    GaussianSettings seen = chosen.gaussians;
    seen.blend = blends_encoded(settings) ? GaussianBlend::Srgb : GaussianBlend::Linear;
    return KernelColour([&gaussians = *part.gaussians, first, eye = view.eye, seen](std::size_t k) {
      return gaussian_colour(gaussians, k - first, eye, seen);
    });
  }
  const RenderSettings lit = with_own_material(settings, chosen);
  const std::vector<MaterialSettings> materials = materials_of(lit);
  const std::size_t material = material_within(part.material, materials.size());
  if (materials[material].kind == Material::Unlit)
    return KernelColour([&kernels](std::size_t k) { return kernels.colours[k]; });
  RELIEF_TRY_ASSIGN(Lighting lighting, make_lighting(lit, view, environments));
  const glm::vec3 axis(-view.rotation[0].z, -view.rotation[1].z, -view.rotation[2].z);
  return KernelColour([&kernels, lighting = std::move(lighting), material, eye = view.eye,
                       orthographic = view.orthographic, axis](std::size_t k) {
    const glm::vec3& normal = kernels.normals[k];
    if (normal == glm::vec3(0.0F)) return kernels.colours[k];  // nothing to light
    const glm::vec3 from_eye(kernels.centres[k] - eye);
    const float distance = glm::length(from_eye);
    const glm::vec3 ray = orthographic || !(distance > 0.0F) ? axis : from_eye / distance;
    return shade(
        lighting, material,
        {.albedo = kernels.colours[k], .normal = normal, .ray = ray, .position = from_eye});
  });
}

Result<KernelColour> VolumeModel::colour_of(const KernelCloud& kernels,
                                            const RenderSettings& settings, const View& view,
                                            EnvironmentCache& environments) const {
  std::vector<KernelColour> colours;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const std::size_t first = kernels.starts.empty() ? 0 : kernels.starts[p];
    RELIEF_TRY_ASSIGN(KernelColour colour,
                      colour_of_part(parts_[p], kernels, first, settings, view, environments));
    colours.push_back(std::move(colour));
  }
  if (colours.size() == 1) return std::move(colours.front());
  return KernelColour([&kernels, colours = std::move(colours)](std::size_t k) {
    return colours[kernels.part_of(k)](k);
  });
}

Result<std::optional<Lighting>> VolumeModel::distant_lights(const RenderSettings& settings,
                                                            const View& view,
                                                            EnvironmentCache& environments) const {
  const Part& part = parts_.front();
  if (parts_.size() > 1 || part.gaussians != nullptr) return std::optional<Lighting>();
  const RenderSettings lit = with_own_material(settings, settings_of(settings, part.settings));
  const std::vector<MaterialSettings> materials = materials_of(lit);
  const bool is_lit =
      materials[material_within(part.material, materials.size())].kind == Material::Lit;
  const bool has_points = std::ranges::any_of(
      lit.lights.list, [](const Light& light) { return light.kind == LightKind::Point; });
  if (!is_lit || has_points || lit.lights.from_environment) return std::optional<Lighting>();
  RELIEF_TRY_ASSIGN(Lighting lighting, make_lighting(lit, view, environments));
  return std::optional(std::move(lighting));
}

Result<std::vector<glm::vec3>> VolumeModel::colours(const KernelCloud& kernels,
                                                    const RenderSettings& settings,
                                                    const View& view,
                                                    EnvironmentCache& environments) const {
  RELIEF_TRY_ASSIGN(const KernelColour colour, colour_of(kernels, settings, view, environments));
  std::vector<glm::vec3> colours(kernels.count());
  tbb::parallel_for(std::size_t{0}, kernels.count(),
                    [&](std::size_t k) { colours[k] = colour(k); });
  return colours;
}

RenderSettings with_own_material(RenderSettings settings, const VolumeSettings& volume) {
  if (!volume.material) return settings;
  settings.material = *volume.material;
  settings.materials.clear();
  return settings;
}

View volume_view(const RenderSettings& settings) {
  return make_view(settings.camera, settings.width, settings.height,
                   1e-6 * glm::distance(settings.camera.eye, settings.camera.target));
}

glm::dvec3 decoded(glm::dvec3 premultiplied, double alpha) {
  if (!(alpha > 0.0)) return glm::dvec3(0.0);
  glm::dvec3 linear(0.0);
  for (glm::length_t c = 0; c < 3; ++c)
    linear[c] = static_cast<double>(linear_from_srgb(static_cast<float>(premultiplied[c] / alpha)));
  return linear * alpha;
}

}  // namespace relief
