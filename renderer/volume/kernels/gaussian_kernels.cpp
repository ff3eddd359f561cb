#include "renderer/volume/kernels/gaussian_kernels.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "common/image/srgb.h"
#include "common/volume/spherical_harmonics.h"

namespace relief {
namespace {

/// Largest encoded colour: decoded, 1e36, it is still a float. Files may have any coefficients.
constexpr double kBrightest = 1e15;

}  // namespace

KernelCloud kernels_of_gaussians(const GaussianCloud& gaussians) {
  KernelCloud cloud;
  cloud.weight = KernelWeight::Peak;
  cloud.centres.assign(gaussians.centres.begin(), gaussians.centres.end());
  cloud.weights = gaussians.opacities;
  cloud.variances.resize(gaussians.size());
  tbb::parallel_for(std::size_t{0}, gaussians.size(), [&](std::size_t k) {
    glm::dmat3 axes = glm::mat3_cast(glm::dquat(gaussians.rotations[k]));
    for (glm::length_t a = 0; a < 3; ++a) axes[a] *= static_cast<double>(gaussians.scales[k][a]);
    cloud.variances[k] = variance_of(axes * glm::transpose(axes));
  });
  return cloud;
}

glm::vec3 gaussian_colour(const GaussianCloud& gaussians, std::size_t k, glm::dvec3 eye,
                          const GaussianSettings& settings) {
  const int degree = std::min(gaussians.degree, settings.degree);
  const std::size_t stored = harmonics_of(gaussians.degree);
  const glm::dvec3 ray = glm::dvec3(gaussians.centres[k]) - eye;
  const double length = glm::length(ray);
  std::array<double, harmonics_of(kMaxHarmonicsDegree)> basis{};
  harmonics_basis(length > 0.0 ? ray / length : glm::dvec3(0.0, 0.0, -1.0), degree, basis);
  glm::dvec3 sum(0.5);
  for (std::size_t c = 0; c < harmonics_of(degree); ++c)
    sum += basis[c] * glm::dvec3(gaussians.harmonics[k * stored + c]);
  glm::vec3 colour(glm::clamp(sum, 0.0, kBrightest));
  if (settings.blend == GaussianBlend::Linear) {
    for (glm::length_t c = 0; c < 3; ++c) colour[c] = linear_from_srgb(colour[c]);
  }
  return colour;
}

}  // namespace relief
