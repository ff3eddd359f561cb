// A scene on the GPU, for the looks that a user chooses one after the other.
#pragma once

#include <memory>
#include <vector>

#include "common/error.h"
#include "loader/loaded_scene.h"
#include "renderer/viewport.h"
#include "viewer/drawing/looks.h"

namespace relief {

/// Keeps a scene and its viewport. What a look needs is uploaded when it is first asked for.
class UploadedScene {
 public:
  /// Uploads what the looks need. Fails as Viewport::create does.
  static Result<std::unique_ptr<UploadedScene>> create(const GlLoader& load,
                                                       std::shared_ptr<const LoadedScene> scene,
                                                       const Looks& looks);

  /// Uploads what these looks need and those before did not. If that fails, the looks before can
  /// still be drawn.
  Status prepare(const Looks& looks);

  [[nodiscard]] Viewport& viewport() { return *viewport_; }
  [[nodiscard]] const LoadedScene& scene() const { return *scene_; }

 private:
  UploadedScene(GlLoader load, std::shared_ptr<const LoadedScene> scene);
  [[nodiscard]] bool has(const RenderSettings& look) const;

  GlLoader load_;
  std::shared_ptr<const LoadedScene> scene_;  ///< outlives the viewport
  RenderModel forms_;
  std::vector<RenderSettings> looks_;  ///< all that were prepared, one of each kind
  std::unique_ptr<Viewport> viewport_;
};

}  // namespace relief
