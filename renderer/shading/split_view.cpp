#include "renderer/shading/split_view.h"

#include "renderer/shading/materials.h"

namespace relief {

Status check_split_view(const RenderSettings& settings, bool on_patches) {
  if (!uses(settings, Material::Split)) return {};
  const bool knows_places =
      settings.engine == EngineKind::Onepass || settings.engine == EngineKind::Raytrace;
  if (!knows_places) {
    return make_error(
        "engine {} can't show the material split: its splats blend, and the samples that a place "
        "lies between are lost; take onepass or raytrace",
        name_of(kEngines, settings.engine));
  }
  if (!on_patches) {
    return make_error(
        "engine {} can't show the material split of a mesh's own triangles, which have no samples; "
        "convert the mesh to a .relief file first",
        name_of(kEngines, settings.engine));
  }
  return {};
}

}  // namespace relief
