// What clips surfels at sharp features ([Ivo 2011]), on the GPU.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/progress.h"
#include "renderer/clip/settings.h"
#include "renderer/engines/surfel/surfel_set.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief::surfel {

/// The clip lines of surfels. As many as there are: more than OpenGL lets a shader see of one
/// buffer are an error, never left out.
struct SurfelClip {
  Table ranges;                       ///< by slot: RG32UI, as shared.h says of records
  Table lines;                        ///< RGBA32F, as shared.h says, in the disc of radius 1
  std::vector<std::uint8_t> clipped;  ///< by slot, whether it has any
};

/// Finds the clip partners of the surfels and uploads them. `settings.rule` is not Off. Fails if it
/// is interrupted or OpenGL can't hold the lines.
Result<SurfelClip> make_surfel_clip(const Gl& gl, const SurfelSet& set,
                                    const ClipSettings& settings, Progress& progress);

}  // namespace relief::surfel
