#include "renderer/volume/volume_model.h"

#include <tbb/parallel_for.h>

#include <cassert>
#include <glm/geometric.hpp>
#include <utility>

#include "common/image/srgb.h"
#include "common/volume/transfer_function.h"
#include "renderer/shading/shading.h"
#include "renderer/volume/gaussian_kernels.h"
#include "renderer/volume/volume_kernels.h"

namespace relief {

Result<const KernelCloud*> VolumeModel::kernels(const RenderSettings& settings,
                                                const Progress& progress) {
  const VolumeSettings& chosen = settings.volume;
  Key key{chosen.transfer, chosen.kernel_sigma, chosen.iso, chosen.iso_opacity};
  if (gaussians_ != nullptr) key = {};  // theirs depend on nothing
  if (key_ == key) return &kernels_;
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
  key_ = std::move(key);
  return &kernels_;
}

Result<KernelColour> VolumeModel::colour_of(const KernelCloud& kernels,
                                            const RenderSettings& settings, const View& view,
                                            EnvironmentCache& environments) const {
  if (gaussians_ != nullptr) {
    return KernelColour([this, eye = view.eye, &chosen = settings.volume.gaussians](std::size_t k) {
      return gaussian_colour(*gaussians_, k, eye, chosen);
    });
  }
  if (settings.material == Material::Unlit)
    return KernelColour([&kernels](std::size_t k) { return kernels.colours[k]; });
  RELIEF_TRY_ASSIGN(Lighting lighting, make_lighting(settings, view, environments));
  const glm::dvec3 axis(-view.rotation[0].z, -view.rotation[1].z, -view.rotation[2].z);
  return KernelColour([&kernels, lighting = std::move(lighting), eye = view.eye,
                       orthographic = view.orthographic, axis](std::size_t k) {
    const glm::vec3& normal = kernels.normals[k];
    if (normal == glm::vec3(0.0F)) return kernels.colours[k];  // nothing to light
    const glm::dvec3 from_eye = kernels.centres[k] - eye;
    const double distance = glm::length(from_eye);
    const glm::dvec3 ray = orthographic || !(distance > 0.0) ? axis : from_eye / distance;
    return shade(lighting, 0,
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
  RELIEF_TRY_ASSIGN(const KernelColour colour, colour_of(kernels, settings, view, environments));
  std::vector<glm::vec3> colours(kernels.count());
  tbb::parallel_for(std::size_t{0}, kernels.count(),
                    [&](std::size_t k) { colours[k] = colour(k); });
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
