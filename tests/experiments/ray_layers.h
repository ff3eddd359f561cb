// How many surfaces lie behind each other in the pixels of a view.
#pragma once

#include <cstdint>
#include <vector>

#include "common/error.h"
#include "common/scene/camera.h"
#include "renderer/geometry/meshes/triangle_mesh.h"

namespace relief::experiment {

/// What the ray through a pixel's middle meets.
struct RayLayers {
  int surfaces = 0;
  double least_gap = 0.0;  ///< the least difference in depth of two of them, world units; infinity
                           ///< if there are fewer
};

/// Row-major, top row first. A ray through an edge meets one surface there. Fails if the memory
/// does not suffice.
Result<std::vector<RayLayers>> find_layers(const TriangleMesh& mesh, const Camera& camera,
                                           std::uint32_t side);

}  // namespace relief::experiment
