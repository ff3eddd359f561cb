// Images by the engine `raytrace`, from triangles to pixels.
#pragma once

#include <memory>

#include "common/error.h"
#include "renderer/engine.h"

namespace relief::raytrace {

/// The model's mesh, or without one the triangulation of its patches (each cell halved along the
/// same diagonal), for any number of views. Environments are loaded once; the tree over the
/// triangles is built for each view, relative to its eye, which keeps single precision's error
/// below a pixel (Dragon: 0.4 s). Fails if the patches have more samples than 32 bits count.
Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request);

}  // namespace relief::raytrace
