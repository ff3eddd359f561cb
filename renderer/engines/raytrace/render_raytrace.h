// A picture by the engine `raytrace`, from triangles to pixels.
#pragma once

#include "common/error.h"
#include "common/progress.h"
#include "renderer/render.h"
#include "renderer/triangle_mesh.h"

namespace relief::raytrace {

/// See render() in renderer/render.h.
Result<RenderResult> render(const TriangleMesh& mesh, const RenderSettings& settings,
                            Progress& progress);

}  // namespace relief::raytrace
