// A scene on the GPU, for the looks that a user chooses one after the other.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/error.h"
#include "loader/scene/loaded_scene.h"
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

  /// Fails if an engine of these looks does not draw them or the scene.
  [[nodiscard]] Status check(const Looks& looks) const;

  /// Returns the looks of each engine for which more has to be uploaded before it draws these: the
  /// engine's looks so far and the new ones.
  [[nodiscard]] std::vector<std::vector<RenderSettings>> to_prepare(const Looks& looks) const;

  /// Uploads what these looks need and those before did not. If that fails, the looks before can
  /// still be drawn. `collected`: of to_prepare(), if that is one engine's.
  Status prepare(const Looks& looks, CollectedStore* collected = nullptr);

  /// Whether the same is uploaded for both lists of looks.
  [[nodiscard]] bool are_alike(std::span<const RenderSettings> a,
                               std::span<const RenderSettings> b) const;

  /// What reads the scene's patches as views need them; null if all are there.
  [[nodiscard]] StreamedPatches* stream() { return stream_.get(); }

  [[nodiscard]] Viewport& viewport() { return *viewport_; }
  [[nodiscard]] const LoadedScene& scene() const { return *scene_; }

 private:
  UploadedScene(GlLoader load, std::shared_ptr<const LoadedScene> scene, StreamOptions options);
  Status prepare_stream(const std::vector<RenderSettings>& looks);

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
