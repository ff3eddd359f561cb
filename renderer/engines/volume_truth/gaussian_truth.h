// 3D Gaussians where rays meet them, without projection.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "common/progress.h"
#include "renderer/engines/volume_truth/sample_image.h"
#include "renderer/engines/volume_truth/truth_settings.h"
#include "renderer/volume/kernels/kernel_cloud.h"
#include "renderer/volume/settings.h"

namespace relief::volume_truth {

/// Fills the image's rays: each Gaussian counts with its largest opacity on the ray, composited by
/// the rules of [Kerbl 2023], front to back in the order that is wanted; equals in the cloud's.
/// Gaussians of no extent are left out. Gives up if `progress` is cancelled.
void meet_gaussians(const KernelCloud& cloud, std::span<const glm::vec3> colours, const View& view,
                    const GaussianSettings& settings, GaussianOrder order, SampleImage& into,
                    Progress& progress);

}  // namespace relief::volume_truth
