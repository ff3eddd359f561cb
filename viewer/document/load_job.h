// A scene that is loaded on a thread of its own.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/error.h"
#include "common/watched_progress.h"
#include "loader/load_scene.h"
#include "viewer/document/scan_points.h"

namespace relief {

/// What is to be loaded.
struct LoadRequest {
  ScenePlan plan;
  LoadOptions options;
  bool shows_points = true;  ///< make a cloud of the points of scans until patches are there
};

/// Loads a scene in the background. Its functions are called from one thread.
class LoadJob {
 public:
  /// `wake` is called on another thread when there is something new to take.
  LoadJob(LoadRequest request, std::function<void()> wake);

  /// Cancels the job and waits for it to end: every stage looks at least every few hundred
  /// milliseconds.
  ~LoadJob();
  LoadJob(const LoadJob&) = delete;
  LoadJob& operator=(const LoadJob&) = delete;

  [[nodiscard]] const ScenePlan& plan() const { return request_.plan; }
  [[nodiscard]] JobProgress progress() const;

  /// Returns the points of the scan, once.
  [[nodiscard]] std::optional<ScanPoints> take_points();
  /// Returns what was noted since the last call.
  [[nodiscard]] std::vector<std::string> take_notes();
  /// Returns the scene or why there is none, once; nothing while the job goes on.
  [[nodiscard]] std::optional<Result<LoadedScene>> take_scene();

 private:
  void run();

  LoadRequest request_;
  std::function<void()> wake_;
  WatchedProgress reporter_;
  mutable std::mutex mutex_;
  std::optional<ScanPoints> points_;
  std::optional<Result<LoadedScene>> scene_;
  std::jthread thread_;  ///< last: it uses all others
};

}  // namespace relief
