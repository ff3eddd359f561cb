// From a textured mesh to coloured splats: paper 000, section 5.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"
#include "common/points.h"
#include "common/progress.h"
#include "preprocess/texture/acquisition/acquisition.h"

namespace relief {

/// Splats with a texture's coefficients. All vectors have the same length. World frame.
struct TexturedSplats {
  std::vector<glm::dvec3> positions;
  std::vector<glm::vec3> normals;  ///< unit, outward
  /// Linear RGB coefficients. Optimised ones may leave the texture's range: their sum does not.
  std::vector<glm::vec3> colours;
  double deviation = 0.0;  ///< h of section 5, world units
};

struct AcquireResult {
  TexturedSplats splats;
  AcquireReport report;
};

/// Spreads points over the mesh, evenly but irregularly, and gives them coefficients. Normals that
/// the mesh lacks are made from its triangles. Fails with one sentence: no triangles, no (finite)
/// texture coordinates, no area, a texture without colour, a number of points out of range, an
/// interruption by the user. The result does not depend on the number of threads.
Result<AcquireResult> acquire_texture(Points mesh, const Image& texture,
                                      const AcquireOptions& options, Progress& progress);

}  // namespace relief
