// The splats of patches' samples as discs, for clip partners.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "renderer/clip/clip_partners.h"

namespace relief {

/// The discs of the samples of some patches, in the order of their records (make_samples()).
struct SampleDiscs {
  SplatDiscs discs;                ///< the patches' frame
  std::vector<glm::vec2> slopes;   ///< of their planes, height per cell
  std::vector<std::size_t> first;  ///< of each patch, and the number of samples as the last
};

/// Makes them as `multipass` draws them: the planes that the records have, and the largest radius
/// that a splat has in any view that does not enlarge it for being tiny, the larger of
/// `radius_factor` times Eq. (1) of [Ochotta 2008] and what covers its parallelogram
/// (shaders/multipass/discs.glsl). Fails only if it is interrupted.
Result<SampleDiscs> make_sample_discs(const PatchModel& model, std::size_t first_patch,
                                      std::size_t patches, double radius_factor,
                                      const Progress& progress);

}  // namespace relief
