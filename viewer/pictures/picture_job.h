// Pictures and films that are made on a thread of their own, as `relief render` makes them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "common/error.h"
#include "common/watched_progress.h"
#include "loader/load_scene.h"
#include "loader/scene/loaded_scene.h"
#include "loader/scene/scene_plan.h"
#include "renderer/settings.h"

namespace relief {

/// A picture or film that is to be made.
struct PictureRequest {
  std::filesystem::path file;         ///< .png or .exr; of a film also .mp4 or .webm
  std::vector<RenderSettings> views;  ///< one, or the frames of a film
  bool is_film = false;               ///< a .png or .exr gets the frame's number in its name
  double frames_per_second = 30.0;
  double exposure = 0.0;  ///< stops, but for an EXR
  bool has_legend = true;

  ScenePlan plan;    ///< what is seen
  LoadOptions load;  ///< how that is read
  /// The plan as it is loaded; not read if serves() says that it is what would be.
  std::shared_ptr<const LoadedScene> scene;
};

/// Fails, with one sentence, if a picture or film cannot have this name.
Status check_picture_name(const std::filesystem::path& file, bool is_film);

/// Returns whether a scene that a window shows is what `relief render` would read of its plan:
/// scans are converted whole, but of patch files a view reads its own tiles.
[[nodiscard]] bool serves(const LoadedScene& scene, const PictureRequest& request);

/// Returns the first path of these that is not there: "dragon.png", "dragon-2.png", "dragon-3.png".
[[nodiscard]] std::filesystem::path free_path(const std::filesystem::path& path);

/// Makes what is requested, with an OpenGL context of its own, current on this thread meanwhile:
/// the bytes are those of `relief render`. Files appear when they are complete. Fails, with one
/// sentence: as load_scene() and render_views(), if a file cannot be written, and once cancelled.
Status make_picture(const PictureRequest& request, Progress& progress);

/// The same in the background.
class PictureJob {
 public:
  explicit PictureJob(PictureRequest request);

  /// Cancels the job and waits for it to end, as LoadJob does.
  ~PictureJob();
  PictureJob(const PictureJob&) = delete;
  PictureJob& operator=(const PictureJob&) = delete;

  void cancel() { progress_.cancel(); }
  [[nodiscard]] bool is_cancelled() const { return progress_.cancelled(); }
  [[nodiscard]] JobProgress progress() const { return progress_.progress(); }
  [[nodiscard]] const PictureRequest& request() const { return request_; }
  /// Returns how it ended, once; nothing while it goes on.
  [[nodiscard]] std::optional<Status> take_result();

 private:
  PictureRequest request_;
  WatchedProgress progress_;
  std::mutex mutex_;
  std::optional<Status> result_;
  std::jthread thread_;  ///< last: it uses all others
};

}  // namespace relief
