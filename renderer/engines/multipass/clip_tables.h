// What clips the splats of a stored model, on the GPU.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "common/error.h"
#include "common/patch.h"
#include "common/progress.h"
#include "renderer/clip/settings.h"
#include "renderer/gl/functions.h"
#include "renderer/gl/object.h"
#include "renderer/store/patch_store.h"

namespace relief::multipass {

/// The clip lines of a model's splats. As many as there are: more than OpenGL lets a shader see of
/// one buffer are an error, never left out.
struct ClipTables {
  std::vector<Table> ranges;  ///< of each page of the store: RG32UI a record, as shared.h says
  Table lines;                ///< RGBA32F a line, as shared.h says
  std::vector<bool> clipped;  ///< parallel to PatchStore::patches: whether some splat of it is
};

/// Finds the clip partners of the splats of a model, instance by instance (those that share
/// patches share their lines, which move with them), and uploads them. `model`: what the store was
/// made of. Fails if it is interrupted or OpenGL can't hold the lines.
Result<ClipTables> make_clip_tables(const Gl& gl, const PatchModel& model, const PatchStore& store,
                                    const ClipSettings& settings, double radius_factor,
                                    Progress& progress);

/// Makes the tables when images need them, and keeps those of the last settings.
class ClipTableCache {
 public:
  /// `model`: what the store is made of; null: its patches come and go. Outlives this.
  void set_model(const PatchModel* model) { model_ = model; }

  /// The tables; null if nothing is clipped. Fails as make_clip_tables() does, and if patches come
  /// and go: their neighbours are not known then.
  Result<const ClipTables*> get(const Gl& gl, const PatchStore& store, const ClipSettings& settings,
                                double radius_factor, Progress& progress);

 private:
  struct Made {
    ClipSettings settings;
    double radius_factor = 0.0;
    ClipTables tables;
  };
  const PatchModel* model_ = nullptr;
  std::optional<Made> made_;
};

}  // namespace relief::multipass
