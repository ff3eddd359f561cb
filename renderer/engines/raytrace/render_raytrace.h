// Pictures by the engine `raytrace`, from triangles to pixels.
#pragma once

#include <memory>

#include "renderer/geometry/triangle_mesh.h"
#include "renderer/prepared.h"

namespace relief::raytrace {

/// A mesh for any number of views. Environments are loaded once; the tree over the triangles is
/// built for each view, relative to its eye, which keeps single precision's error below a pixel
/// (Dragon: 0.4 s).
[[nodiscard]] std::unique_ptr<PreparedModel> prepare(const TriangleMesh& mesh);
[[nodiscard]] std::unique_ptr<PreparedModel> prepare(TriangleMesh&& mesh);

}  // namespace relief::raytrace
