// Chooses each patch's spacing by the error that it leaves.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "preprocess/partition/partition.h"

namespace relief {

/// Samples a point of patches that meet: overlapping ones have about as many with their margins.
/// There are up to `kMost` where the surface of a mesh asks for them.
inline constexpr double kFewestSamplesPerPoint = 1.1;
inline constexpr double kMostSamplesPerPoint = 2.0;

/// How many samples that many points get if their shape says nothing.
[[nodiscard]] inline double usual_samples(std::size_t points, bool seams) {
  return (seams ? kFewestSamplesPerPoint : 1.0) * static_cast<double>(points);
}

/// How many samples patches shall have, and how they share them.
struct SampleBudget {
  std::vector<double> factors;  ///< each patch's spacing, in spacings of the model
  double samples = 0.0;         ///< of all
};

struct SampleRange {
  double fewest = 0.0;
  double most = 0.0;  ///< the same: as many
};

/// Shares out samples to the patches of regions by what they gain from them.
///
/// Bilinear cells of side h are off a surface that bends by k by about k h^2, and there are 1 / h^2
/// of them on a unit of area: of all spacings that need as many samples, those that fall with the
/// cube root of a patch's bend leave the least squared error. A patch bends by how far the
/// neighbours of its points are from a plane (SurfaceSamples::roughness). There are as many samples
/// as make that error, over the whole model, a twentieth of its spacing, which is the step that
/// heights are rounded to.
///
/// `at_crease`: of each point, 1 for those whose neighbours lie on two sides of a crease. These say
/// nothing of how either side bends. `range`: how many samples there may be. For meshes, whose
/// points have no noise that samples would follow.
///
/// `widths`: of the faces that regions are of, world units, infinite where unknown; it may be
/// empty. A narrow face has two rows of samples or more, for which half of all samples may be
/// spent: one that lies between the rows of its grid would be lost.
[[nodiscard]] SampleBudget share_samples(const SurfaceSamples& samples,
                                         const std::vector<Region>& regions,
                                         const std::vector<std::uint8_t>& at_crease,
                                         SampleRange range, std::span<const double> widths = {});

}  // namespace relief
