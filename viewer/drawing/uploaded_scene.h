// A scene on the GPU, for the looks that a user chooses one after the other.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "common/error.h"
#include "loader/loaded_scene.h"
#include "loader/stream/streamed_patches.h"
#include "renderer/gl/open_gl.h"
#include "renderer/viewport.h"
#include "viewer/drawing/looks.h"

namespace relief {

/// How a scene whose patches are read as views need them is kept.
struct StreamOptions {
  StreamBudget budget = {};            ///< 0: what suits the renderer
  std::function<void()> wake = [] {};  ///< called on another thread when something was read
};

/// Keeps a scene and its viewport. What a look needs is uploaded when it is first asked for.
class UploadedScene {
 public:
  /// Uploads what the looks need. `collected`: as Viewport::create has it. Fails as that does.
  static Result<std::unique_ptr<UploadedScene>> create(const GlLoader& load,
                                                       std::shared_ptr<const LoadedScene> scene,
                                                       const Looks& looks,
                                                       const StreamOptions& options = {},
                                                       CollectedStore* collected = nullptr);

  /// Uploads what these looks need and those before did not. If that fails, the looks before can
  /// still be drawn.
  Status prepare(const Looks& looks, CollectedStore* collected = nullptr);

  /// What reads the scene's patches as views need them; null if all are there.
  [[nodiscard]] StreamedPatches* stream() { return stream_.get(); }

  [[nodiscard]] Viewport& viewport() { return *viewport_; }
  [[nodiscard]] const LoadedScene& scene() const { return *scene_; }

 private:
  UploadedScene(GlLoader load, std::shared_ptr<const LoadedScene> scene, StreamOptions options);
  Status prepare_stream(const std::vector<RenderSettings>& looks);
  [[nodiscard]] bool has(const RenderSettings& look) const;

  GlLoader load_;
  std::shared_ptr<const LoadedScene> scene_;  ///< outlives the viewport
  RenderModel forms_;
  StreamOptions options_;
  std::vector<RenderSettings> looks_;     ///< all that were prepared, one of each kind
  std::shared_ptr<const OpenGl> opengl_;  ///< of the stream
  std::unique_ptr<StreamedPatches> stream_;
  StoreNeeds stream_needs_;
  std::unique_ptr<Viewport> viewport_;
};

}  // namespace relief
