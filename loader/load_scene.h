// Reads the models of a scene, in the forms that the engines of its views draw.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/points.h"
#include "common/progress.h"
#include "common/scene/scene.h"
#include "loader/scene/loaded_scene.h"
#include "loader/scene/scene_plan.h"
#include "preprocess/convert_options.h"
#include "preprocess/readers/selection.h"
#include "preprocess/texture/acquisition/acquisition.h"
#include "preprocess/texture/files/load_textures.h"
#include "preprocess/volumes/read_volume.h"
#include "renderer/engine_registry.h"

namespace relief {

/// The forms that the engines of a scene prefer to draw.
struct FormNeeds {
  bool patches = false;
  bool splats = false;
  bool mesh = false;
  bool textured_splats = false;  ///< splats keep their texture (EngineCapabilities)
};

/// Returns the views to draw of a scene whose bounds are known.
using ViewsOf = std::function<Result<std::vector<RenderSettings>>(const PatchModel& extent)>;

/// What is read of patch files, and kept of patches: all that there is; or what the views of a plan
/// show, once complete_look() has completed them (loader/scene/first_look.h). An unlit view shows
/// no normals, a mirror no colours, a distant view no fine texels.
enum class KeptDetail : std::uint8_t { All, OfViews };

struct LoadOptions {
  TextureChoice textures;    ///< of scans and meshes
  ReadOptions read;          ///< how scans and meshes are read
  VolumeReadOptions volume;  ///< how volumes are read
  /// Options for making splats of a mesh for which `textures` names an image. The cutoff is always
  /// that of the first view's options.
  AcquireOptions acquisition;
  std::optional<ColourBy> colour_by;  ///< in place of colours and textures
  KeptDetail detail = KeptDetail::All;
  /// How scans and meshes become patches; distances are added if they are what is coloured by.
  ConvertOptions convert;
  /// Is given the points of each scan or mesh before they are converted, on the loading thread;
  /// null: nobody waits for them.
  std::function<void(const Points&)> on_points = {};
};

/// Reads the models and puts them in their positions. Reads a file that several of them name once.
/// A scan or mesh gives the forms that are needed: its points as splats, its triangles, and patches
/// by a conversion, which also stand for triangles if it has none.
/// Reads only those tiles of a patch file that `views` show
/// (renderer/view/patches_in_view.h); reads all without `views`, and if splats or a mesh are
/// needed. Of patch files reads only the maps that `sections`
/// names. With options.colour_by fails if there are several models, or if a patch file lacks the
/// scalar.
Result<LoadedScene> load_models(const std::vector<SceneModel>& models, const LoadOptions& options,
                                FormNeeds needs, Progress& progress, const ViewsOf& views = {},
                                const PatchSections& sections = {});

/// Loads the models that the views of a plan show, in the forms that their engines prefer. The
/// views' settings follow by render_settings_of (loader/scene/view_settings.h), with the scene's
/// patches for the extent.
Result<LoadedScene> load_scene(const ScenePlan& plan, const LoadOptions& options,
                               Progress& progress, std::span<const EngineEntry> among = engines());

}  // namespace relief
