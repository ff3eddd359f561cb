#include "renderer/render.h"

#include "renderer/engines/onepass/render_onepass.h"
#include "renderer/engines/raytrace/render_raytrace.h"
#include "renderer/mesh_of_patches.h"

namespace relief {

Result<RenderResult> render(const PatchModel& model, const RenderSettings& settings,
                            Progress& progress) {
  if (settings.engine == EngineKind::Raytrace) {
    const auto mesh = mesh_of_patches(model);
    if (!mesh) return mesh.error();
    return raytrace::render(*mesh, settings, progress);
  }
  return onepass::render(model, settings);
}

Result<RenderResult> render(const TriangleMesh& mesh, const RenderSettings& settings,
                            Progress& progress) {
  return raytrace::render(mesh, settings, progress);
}

}  // namespace relief
