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
#include "renderer/volume/gaussian_kernels.h"
#include "renderer/volume/volume_kernels.h"

namespace relief {

namespace {

const VolumeSettings& settings_of(const RenderSettings& settings, std::size_t index) {
  return index < settings.volumes.size() ? settings.volumes[index] : settings.volume;
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
    if (parts_[p].volume != nullptr)
      keys[p] = {chosen.transfer, chosen.kernel_sigma, chosen.iso, chosen.iso_opacity};
  }
  if (has_gaussians && has_volume() && settings.volume.attenuation == Attenuation::Exponential) {
    return make_error(
        "3D Gaussians have opacities, which are no optical depths: beside a volume take "
        "--attenuation linear");
  }
  if (keys_ == keys) return &kernels_;
  keys_.reset();
  ++version_;
  std::vector<KernelCloud> clouds;
  for (const Part& part : parts_) {
    RELIEF_TRY_ASSIGN(auto cloud, kernels_of(part, settings_of(settings, part.settings), progress));
    if (progress.cancelled()) return interrupted_error();
    clouds.push_back(std::move(cloud));
  }
  kernels_ = merged(std::move(clouds));
  keys_ = std::move(keys);
  return &kernels_;
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

void VolumeModel::shade_volume(const KernelCloud& kernels, std::size_t first, std::size_t last,
                               const Lighting& lighting, std::size_t material, const View& view,
                               std::vector<glm::vec3>& colours) {
  const glm::dvec3 axis(-view.rotation[0].z, -view.rotation[1].z, -view.rotation[2].z);
  tbb::parallel_for(first, last, [&](std::size_t k) {
    const glm::vec3& normal = kernels.normals[k];
    if (normal == glm::vec3(0.0F)) {  // nothing to light
      colours[k] = kernels.colours[k];
      return;
    }
    const glm::dvec3 from_eye = kernels.centres[k] - view.eye;
    const double distance = glm::length(from_eye);
    const glm::dvec3 ray = view.orthographic || !(distance > 0.0) ? axis : from_eye / distance;
    colours[k] = shade(lighting, material,
                       {.albedo = kernels.colours[k],
                        .normal = normal,
                        .ray = glm::vec3(ray),
                        .position = glm::vec3(from_eye)});
  });
}

Result<std::vector<glm::vec3>> VolumeModel::colours(const KernelCloud& kernels,
                                                    const RenderSettings& settings,
                                                    const View& view,
                                                    EnvironmentCache& environments) const {
  std::vector<glm::vec3> colours(kernels.count());
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    const VolumeSettings& chosen = settings_of(settings, part.settings);
    const std::size_t first = kernels.starts.empty() ? 0 : kernels.starts[p];
    const std::size_t last = p + 1 < kernels.starts.size() ? kernels.starts[p + 1] : colours.size();
    if (part.gaussians != nullptr) {
      GaussianSettings seen = chosen.gaussians;
      seen.blend = blends_encoded(settings) ? GaussianBlend::Srgb : GaussianBlend::Linear;
      const std::vector<glm::vec3> own = gaussian_colours(*part.gaussians, view.eye, seen);
      std::copy(own.begin(), own.end(), colours.begin() + static_cast<std::ptrdiff_t>(first));
      continue;
    }
    // Of a volume's own material only the kind, if the image does not have several.
    RenderSettings lit = settings;
    if (chosen.material) {
      lit.material = *chosen.material;
      lit.materials.clear();
    }
    const std::vector<MaterialSettings> materials = materials_of(lit);
    const std::size_t material = part.material < materials.size() ? part.material : 0;
    if (materials[material].kind == Material::Unlit) {
      std::copy(kernels.colours.begin() + static_cast<std::ptrdiff_t>(first),
                kernels.colours.begin() + static_cast<std::ptrdiff_t>(last),
                colours.begin() + static_cast<std::ptrdiff_t>(first));
      continue;
    }
    RELIEF_TRY_ASSIGN(const Lighting lighting, make_lighting(lit, view, environments));
    shade_volume(kernels, first, last, lighting, material, view, colours);
  }
  return colours;
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
