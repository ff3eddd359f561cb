// The kernels of a scene of 3D Gaussians [Kerbl 2023].
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

#include "common/volume/gaussian_cloud.h"
#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"

namespace relief {

/// A kernel for each Gaussian, without its colour, which depends on the eye.
[[nodiscard]] KernelCloud kernels_of_gaussians(const GaussianCloud& gaussians);

/// The colour of Gaussian k that an eye (world) sees, as it is blended: from harmonics up to the
/// settings' degree, not below 0.
[[nodiscard]] glm::vec3 gaussian_colour(const GaussianCloud& gaussians, std::size_t k,
                                        glm::dvec3 eye, const GaussianSettings& settings);

}  // namespace relief
