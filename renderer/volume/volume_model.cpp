#include "renderer/volume/volume_model.h"

#include <tbb/parallel_for.h>

#include <cassert>
#include <glm/geometric.hpp>
#include <utility>

#include "common/image/srgb.h"
#include "common/volume/transfer_function.h"
#include "renderer/shading/shading.h"
#include "renderer/volume/clip_kernels.h"
#include "renderer/volume/coarse_kernels.h"
#include "renderer/volume/extent.h"
#include "renderer/volume/gaussian_kernels.h"
#include "renderer/volume/volume_kernels.h"

namespace relief {

Result<const KernelCloud*> VolumeModel::kernels(const RenderSettings& settings,
                                                const Progress& progress) {
  const VolumeSettings& chosen = settings.volume;
  Key key{chosen.transfer, chosen.kernel_sigma, chosen.iso, chosen.iso_opacity, chosen.clip};
  if (gaussians_ != nullptr) {
    key = {};
    key.clip = chosen.clip;
  }
  key.level = level_for(settings);
  if (key.level > 0) key.attenuation = chosen.attenuation;
  if (key_ == key) return &kernels_;
  RELIEF_TRY_ASSIGN(const auto box, clip_box(settings));
  key_.reset();
  ++version_;
  if (gaussians_ != nullptr) {
    kernels_ = kernels_of_gaussians(*gaussians_);
  } else {
    RELIEF_TRY_ASSIGN(const TransferFunction function,
                      transfer_function_for(chosen.transfer, *volume_));
    kernels_ = kernels_of_volume(*volume_, function, chosen, progress);
    if (progress.cancelled()) return interrupted_error();
  }
  if (box) clip_kernels(kernels_, *box);
  if (key.level > 0) {
    kernels_ = coarse_kernels(std::move(kernels_), std::get<RegularGrid>(volume_->placement),
                              key.level, chosen.attenuation);
  }
  key_ = std::move(key);
  return &kernels_;
}

int VolumeModel::level_for(const RenderSettings& settings) const {
  const VolumeSettings& chosen = settings.volume;
  if (chosen.pixels_per_node <= 0.0 || volume_ == nullptr || chosen.iso) return 0;
  const auto* const grid = std::get_if<RegularGrid>(&volume_->placement);
  if (grid == nullptr) return 0;
  return coarse_level(*volume_, *grid, volume_view(settings), chosen.pixels_per_node);
}

Result<std::optional<Bounds>> VolumeModel::clip_box(const RenderSettings& settings) const {
  if (!settings.volume.clip) return std::optional<Bounds>();
  const std::vector<glm::dvec3> extent =
      gaussians_ != nullptr ? extent_of(*gaussians_) : extent_of(*volume_);
  if (extent.empty()) return std::optional<Bounds>();  // a scene without Gaussians
  RELIEF_TRY_ASSIGN(const Bounds box, place_clip_box(*settings.volume.clip, bounds_of(extent)));
  return std::optional(box);
}

Result<std::vector<glm::vec3>> VolumeModel::colours(const KernelCloud& kernels,
                                                    const RenderSettings& settings,
                                                    const View& view,
                                                    EnvironmentCache& environments) const {
  if (gaussians_ != nullptr)
    return gaussian_colours(*gaussians_, view.eye, settings.volume.gaussians);
  if (settings.material == Material::Unlit) return kernels.colours;
  RELIEF_TRY_ASSIGN(const Lighting lighting, make_lighting(settings, view, environments));
  std::vector<glm::vec3> colours(kernels.count());
  const glm::dvec3 axis(-view.rotation[0].z, -view.rotation[1].z, -view.rotation[2].z);
  tbb::parallel_for(std::size_t{0}, kernels.count(), [&](std::size_t k) {
    const glm::vec3& normal = kernels.normals[k];
    if (normal == glm::vec3(0.0F)) {  // nothing to light
      colours[k] = kernels.colours[k];
      return;
    }
    const glm::dvec3 from_eye = kernels.centres[k] - view.eye;
    const double distance = glm::length(from_eye);
    const glm::dvec3 ray = view.orthographic || !(distance > 0.0) ? axis : from_eye / distance;
    colours[k] = shade(lighting, 0,
                       {.albedo = kernels.colours[k],
                        .normal = normal,
                        .ray = glm::vec3(ray),
                        .position = glm::vec3(from_eye)});
  });
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
