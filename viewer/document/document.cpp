#include "viewer/document/document.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "common/io/extension.h"
#include "loader/models/load_volume.h"
#include "loader/scene/scene_plan.h"

namespace relief {
namespace {

/// One scene of all files. A scene file has models and views of its own, so that it is alone.
Result<ScenePlan> plan_of(const std::vector<std::filesystem::path>& files,
                          const SceneSettings& settings, const VolumeReadOptions& volumes) {
  RELIEF_TRY_ASSIGN(ScenePlan plan, plan_scene(files.front(), settings));
  for (std::size_t k = 1; k < files.size(); ++k) {
    if (!plan.file.empty() || lower_extension(files[k]) == ".json") {
      const auto& scene = plan.file.empty() ? files[k] : plan.file;
      return make_error("{}: is a scene, which is opened alone", scene.string());
    }
    plan.models.push_back({.file = files[k]});
  }
  plan.views.resize(1);  // a window shows one at a time
  RELIEF_TRY(find_inputs(plan));
  fit_engine(plan, volumes);
  return plan;
}

}  // namespace

Status Document::open(const std::vector<std::filesystem::path>& files,
                      const SceneSettings& settings) {
  RELIEF_TRY_ASSIGN(ScenePlan plan, plan_of(files, settings, options_.volume));
  if (!std::exchange(is_other_, true)) shown_ = opened_;
  opened_.files = files;
  start(std::move(plan), true);
  return {};
}

Status Document::add(const std::vector<std::filesystem::path>& files,
                     const SceneSettings& settings) {
  std::vector<std::filesystem::path> all = opened_.files;
  for (const auto& file : files) {
    if (std::find(all.begin(), all.end(), file) == all.end()) all.push_back(file);
  }
  return open(all, settings);
}

void Document::close() {
  job_.reset();
  opened_ = shown_ = {};
  is_other_ = false;
}

void Document::cancel() {
  job_.reset();
  if (is_other_) return_to_shown();
}

void Document::return_to_shown() {
  opened_ = std::exchange(shown_, {});
  is_other_ = false;
}

void Document::reload(const SceneSettings& settings) {
  ScenePlan plan = opened_.plan;
  plan.views.front().settings = overlay(plan.views.front().settings, settings);
  start(std::move(plan), false);
}

void Document::start(ScenePlan plan, bool shows_points) {
  job_.reset();
  opened_.plan = plan;
  opened_.read = look_at_files();
  opened_.seen = opened_.read;
  job_ = std::make_unique<LoadJob>(LoadRequest{std::move(plan), options_, shows_points}, wake_);
}

std::vector<Document::FileState> Document::look_at_files() const {
  std::vector<FileState> states;
  for (const SceneModel& model : opened_.plan.models) {
    std::error_code gone;
    FileState state;
    state.time = std::filesystem::last_write_time(model.file, gone);
    if (!gone) state.bytes = std::filesystem::file_size(model.file, gone);
    states.push_back(gone ? FileState{} : state);
  }
  return states;
}

bool Document::has_changed_on_disk() {
  if (opened_.plan.models.empty()) return false;
  std::vector<FileState> now = look_at_files();
  const bool rests = now == opened_.seen;
  opened_.seen = std::move(now);
  // A file that is gone is about to come back, or what is shown is all that is left of it.
  const bool is_there = std::none_of(opened_.seen.begin(), opened_.seen.end(),
                                     [](const FileState& s) { return s.bytes == 0; });
  return rests && is_there && opened_.seen != opened_.read;
}

Arrival Document::take() {
  Arrival arrival;
  if (job_ == nullptr) return arrival;
  arrival.points = job_->take_points();
  arrival.notes = job_->take_notes();
  auto scene = job_->take_scene();
  if (arrival.points || (scene && *scene)) {
    arrival.is_other = std::exchange(is_other_, false);
    shown_ = {};
  }
  if (!scene) return arrival;
  if (*scene)
    arrival.scene = std::make_shared<const LoadedScene>(*std::move(*scene));
  else
    arrival.failure = scene->error().message;
  cancel();
  return arrival;
}

}  // namespace relief
