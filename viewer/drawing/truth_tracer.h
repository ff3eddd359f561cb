// Ray-traced images of the views that a window shows, made in the background.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/error.h"
#include "common/image/image.h"
#include "common/progress.h"
#include "loader/load_scene.h"
#include "renderer/settings.h"

namespace relief {

/// What is traced.
struct TruthModel {
  std::shared_ptr<const LoadedScene> scene;
  ScenePlan plan;       ///< of its files
  LoadOptions options;  ///< that it was loaded with
};

/// Images of a request, in its order, and what their triangles are.
struct Truth {
  std::vector<Image> images;
  bool is_input = false;  ///< faces of the files; otherwise the patches' own triangles
};

/// Renders with the engine `raytrace` on a thread of its own, which keeps the triangles. Its
/// functions are called from one thread.
class TruthTracer {
 public:
  /// `wake` is called on the other thread when there is something to take.
  TruthTracer(TruthModel model, std::function<void()> wake);

  /// Cancels and waits for the thread.
  ~TruthTracer();
  TruthTracer(const TruthTracer&) = delete;
  TruthTracer& operator=(const TruthTracer&) = delete;

  [[nodiscard]] const std::shared_ptr<const LoadedScene>& scene() const { return model_.scene; }

  /// Begins images of these views in place of those before.
  void begin(std::vector<RenderSettings> views);

  /// Gives up what was begun.
  void cancel();

  /// Returns what was begun, once it is done.
  [[nodiscard]] std::optional<Result<Truth>> take();

  /// Returns the share of the current image that is done, 0 to 1.
  [[nodiscard]] double share() const;

 private:
  class Reporter;
  class Worker;
  void run();

  TruthModel model_;
  std::function<void()> wake_;
  mutable std::mutex mutex_;
  std::condition_variable asked_;
  std::vector<RenderSettings> views_;  ///< to begin with; empty: none
  std::shared_ptr<Reporter> reporter_;
  std::optional<Result<Truth>> done_;
  bool ends_ = false;
  std::jthread thread_;  ///< last: it uses all others
};

/// Returns the settings of the image that `look` is compared with.
[[nodiscard]] RenderSettings truth_of(RenderSettings look);

}  // namespace relief
