// What a viewer has open: files, what is loaded of them, and the job that loads more.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/error.h"
#include "loader/load_scene.h"
#include "viewer/document/load_job.h"

namespace relief {

/// Something new about a document.
struct Arrival {
  std::optional<ScanPoints> points;          ///< to be shown until the scene is there
  std::shared_ptr<const LoadedScene> scene;  ///< in place of what was there
  std::optional<std::string> failure;        ///< why there is no scene
  std::vector<std::string> notes;
  bool is_other = false;  ///< the first of other files than before
};

/// The open files. Loading happens in the background; what is there stays until it is replaced.
class Document {
 public:
  /// `options`: how all files are read. `wake`: as LoadJob's.
  Document(LoadOptions options, std::function<void()> wake)
      : options_(std::move(options)), wake_(std::move(wake)) {}

  /// Begins to load files in place of those that are open. Fails, with one sentence, if there is no
  /// such file or a scene file is wrong; then nothing changes. If nothing of them can be loaded,
  /// those that were shown are the open ones again.
  Status open(const std::vector<std::filesystem::path>& files, const SceneSettings& settings);

  /// The same with the open files and others.
  Status add(const std::vector<std::filesystem::path>& files, const SceneSettings& settings);

  /// Closes all files.
  void close();

  /// Loads the open files again for a view with these settings, if that is worth while: files have
  /// changed, or a patch file has tiles and the view shows others.
  void reload(const SceneSettings& settings);

  /// Whether a file has changed on disk since it was read, and is complete again: its size was the
  /// same a look before.
  [[nodiscard]] bool has_changed_on_disk();

  /// What has come since the last call.
  Arrival take();

  /// Ends the job, if there is one.
  void cancel();

  [[nodiscard]] bool is_loading() const { return job_ != nullptr; }
  [[nodiscard]] JobProgress progress() const { return job_ ? job_->progress() : JobProgress{}; }
  /// Also files of which nothing is loaded yet.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return opened_.files; }
  /// That of what is shown, or of what is loaded if nothing is shown.
  [[nodiscard]] const ScenePlan& plan() const {
    return is_other_ && !shown_.files.empty() ? shown_.plan : opened_.plan;
  }

  LoadOptions& options() { return options_; }

 private:
  struct FileState {
    std::filesystem::file_time_type time;
    std::uintmax_t bytes = 0;
    bool operator==(const FileState&) const = default;
  };
  struct Opened {
    std::vector<std::filesystem::path> files;
    ScenePlan plan;               ///< of the files
    std::vector<FileState> read;  ///< of the files of the plan, when the job began
    std::vector<FileState> seen;  ///< at the last look
  };
  [[nodiscard]] std::vector<FileState> look_at_files() const;
  void start(ScenePlan plan, bool shows_points);
  void return_to_shown();

  LoadOptions options_;
  std::function<void()> wake_;
  Opened opened_;
  Opened shown_;  ///< while is_other_
  std::unique_ptr<LoadJob> job_;
  bool is_other_ = false;  ///< the job's files are others than those shown
};

}  // namespace relief
