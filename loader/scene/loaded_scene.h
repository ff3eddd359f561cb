// The models of a scene in memory.
#pragma once

#include <memory>
#include <optional>

#include "common/patch.h"
#include "common/patch_file/patch_file.h"
#include "common/scalars/colour_scale.h"
#include "renderer/geometry/meshes/triangle_mesh.h"
#include "renderer/geometry/splat_cloud.h"
#include "renderer/model.h"

namespace relief {

class TileSource;

struct LoadedScene {
  /// The patches of all models, if an engine draws them. The bounds are always there and do not
  /// depend on the engines, so that cameras have the same position for all.
  PatchModel patches;
  std::optional<TriangleMesh> mesh;
  std::optional<SplatCloud> splats;
  std::optional<ScalarVolume> volume;      ///< then there is nothing else
  std::optional<GaussianCloud> gaussians;  ///< likewise
  std::optional<VolumeParts> volumes;      ///< several, or beside surfaces
  bool has_faces = false;                  ///< some model is a mesh, or was converted from one
  bool mesh_is_input = false;              ///< all triangles of the mesh are faces of the files
  std::optional<ColourScale> colours;      ///< what LoadOptions::colour_by made of it
  SectionBytes read;                       ///< of all patch files
  /// Where patches are read as views need them (loader/stream/); `patches` then has none.
  std::shared_ptr<TileSource> tiles;

  /// Whether there are volumes or 3D Gaussians.
  [[nodiscard]] bool has_kernels() const { return volume || gaussians || volumes; }

  [[nodiscard]] RenderModel forms() const {
    RenderModel forms = RenderModel::of(patches);
    if (mesh) forms.add(*mesh);
    if (splats) forms.add(*splats);
    if (volume) forms.add(*volume);
    if (gaussians) forms.add(*gaussians);
    if (volumes) forms.add(*volumes);
    return forms;
  }
};

}  // namespace relief
