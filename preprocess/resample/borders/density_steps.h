// Where a dense part of a scan ends and a sparse one goes on.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "common/neighbours/radius_search.h"
#include "preprocess/partition/partition.h"

namespace relief {

/// A gap within a surface is no border: there are points beyond it, within 45 degrees of outward
/// and so many spacings.
inline constexpr double kGapCosine = 0.7;
inline constexpr double kWidestGap = 4.0;

/// At a step of density neighbours have spacings that differ by so much. Those of even scans differ
/// by less.
inline constexpr float kDensityStep = 3.0F;

/// The sparse points at steps of density. The nearest points of one in a dense part are all dense,
/// so the dense part seems to end there.
class DensitySteps {
 public:
  DensitySteps(const SurfaceSamples& samples, const NeighbourGraph& graph);

  /// Whether the surface goes on beyond a point of the dense part, in sparse points. `outward`: a
  /// unit direction in its tangent plane.
  [[nodiscard]] bool go_on(std::uint32_t point, glm::dvec3 outward) const;

 private:
  /// Sparse points of about one spacing.
  struct Octave {
    double reach = 0.0;
    std::vector<std::uint32_t> points;
    RadiusSearch search;
  };

  SurfaceSamples samples_;
  std::vector<Octave> octaves_;
};

}  // namespace relief
