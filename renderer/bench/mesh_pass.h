// The input mesh as any renderer of triangles would draw it.
#pragma once

#include <memory>

#include "common/error.h"
#include "renderer/frame/gl_engine.h"
#include "renderer/geometry/meshes/triangle_mesh.h"
#include "renderer/gl/open_gl.h"

namespace relief::bench_passes {

/// Uploads the mesh: 32-bit indices, positions and normals as floats, colours too if it has any and
/// the material shows them. Its images are one indexed draw with the depth test, nothing culled.
/// Fails if OpenGL lacks memory or the mesh has more than 2^31 - 1 indices.
Result<std::unique_ptr<GlPreparedModel>> prepare_mesh(std::shared_ptr<const OpenGl> opengl,
                                                      const TriangleMesh& mesh,
                                                      const RenderSettings& settings);

}  // namespace relief::bench_passes
