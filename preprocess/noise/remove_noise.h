// Removes the noise of a scan before a surface is made of it.
#pragma once

#include <cstdint>
#include <optional>

#include "preprocess/noise/move_points.h"

namespace relief {

struct NoiseReport {
  double noise = 0.0;       ///< standard deviation along the normal, median, world units
  std::uint64_t moved = 0;  ///< points that noise was removed from
};

struct NoiselessPoints {
  SmoothPoints smooth;  ///< by point; empty if no point moved
  NoiseReport report;
};

/// Removes the points' noise along the normal, with the support that this takes and no more: a scan
/// without noise stays as it is, and so do points whose noise is below a twentieth of their
/// spacing, the step that heights are rounded to.
///
/// `spacing`: of the scan at each point, world units. `given`: the noise's standard deviation,
/// world units, above 0; nothing: as measured (estimate_noise). The result does not depend on the
/// number of threads; it is meaningless if the user interrupts.
[[nodiscard]] NoiselessPoints remove_noise(const std::vector<glm::dvec3>& positions,
                                           const std::vector<float>& spacing,
                                           std::optional<double> given, Progress& progress);

}  // namespace relief
