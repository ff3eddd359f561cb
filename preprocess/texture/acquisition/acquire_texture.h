// Makes coloured splats from a textured mesh ([Zwicker 2001], section 5).
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/texture/acquisition/acquisition.h"

namespace relief {

/// Splats with a texture's coefficients. All vectors have equal length. World frame.
struct TexturedSplats {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< unit, outward
  /// Linear RGB coefficients. Optimised coefficients may leave the texture's range, but their sum
  /// does not.
  std::vector<glm::vec3> colours;
  double deviation = 0.0;  ///< h of section 5, world units
};

struct AcquireResult {
  TexturedSplats splats;
  AcquireReport report;
};

/// Spreads points over the mesh, evenly but irregularly, and computes their coefficients. Missing
/// normals are computed from the triangles. Fails with one sentence if there are no triangles, no
/// finite texture coordinates or no area, if the texture has no colour, if the number of points is
/// out of range, or if the user interrupts. The result does not depend on the number of threads.
Result<AcquireResult> acquire_texture(Points mesh, const Image& texture,
                                      const AcquireOptions& options, Progress& progress);

}  // namespace relief
