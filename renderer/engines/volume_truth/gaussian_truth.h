// 3D Gaussians where rays meet them, without projection.
#pragma once

#include <glm/vec3.hpp>
#include <span>

#include "common/progress.h"
#include "renderer/engines/volume_truth/sample_image.h"
#include "renderer/engines/volume_truth/truth_settings.h"
#include "renderer/volume/kernel_cloud.h"
#include "renderer/volume/settings.h"

namespace relief::volume_truth {

/// Where a ray is nearest to a Gaussian's centre, measured by its standard deviations.
struct NearestPlace {
  double depth = 0.0;    ///< in units of `along`; at least 0
  double squared = 0.0;  ///< the Mahalanobis distance there
};

/// `inverse_root`: the inverse of a root of the variance, which makes the Gaussian a unit one.
[[nodiscard]] NearestPlace nearest_place(const glm::dmat3& inverse_root, glm::dvec3 centre,
                                         glm::dvec3 start, glm::dvec3 along);

/// Fills the image's rays: each Gaussian counts with its largest opacity on the ray, composited by
/// the rules of [Kerbl 2023], front to back in the order that is wanted; equals in the cloud's.
/// Gaussians of no extent are left out. Gives up if `progress` is cancelled.
void meet_gaussians(const KernelCloud& cloud, std::span<const glm::vec3> colours, const View& view,
                    const GaussianSettings& settings, GaussianOrder order, SampleImage& into,
                    Progress& progress);

}  // namespace relief::volume_truth
