// Surfels on the GPU: what does not change from frame to frame.
#pragma once

#include <optional>

#include "common/error.h"
#include "renderer/engines/surfel/surfel_set.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"

namespace relief::surfel {

/// Tables by slot (shaders/surfel/layout.h). What a cloud lacks does not exist.
struct SurfelTables {
  Table axes;
  Table bends;
  Table identities;  ///< grid coordinates, patch id + 1, material
  std::optional<Table> colours;
  std::optional<Table> texcoords;
  std::optional<Texture> image;
};

/// Uploads them. Fails if they are more than this OpenGL holds.
Result<SurfelTables> upload_surfels(const Gl& gl, const SurfelSet& set, const SplatCloud& cloud);

}  // namespace relief::surfel
