#include "viewer/document/load_job.h"

#include <utility>

namespace relief {

LoadJob::LoadJob(LoadRequest request, std::function<void()> wake)
    : request_(std::move(request)), wake_(std::move(wake)), thread_([this] { run(); }) {}

LoadJob::~LoadJob() {
  reporter_.cancel();
}

void LoadJob::run() {
  LoadOptions options = request_.options;
  if (request_.shows_points) {
    options.on_points = [this](const Points& points) {
      ScanPoints shown = scan_points_of(points);
      {
        const std::lock_guard lock(mutex_);
        points_ = std::move(shown);
      }
      wake_();
    };
  }
  auto scene = [&]() -> Result<LoadedScene> {
    try {
      return load_scene(request_.plan, options, reporter_);
    } catch (const std::bad_alloc&) {
      return make_error("{}: there is not enough memory for this model",
                        request_.plan.models.front().file.string());
    }
  }();
  {
    const std::lock_guard lock(mutex_);
    scene_ = std::move(scene);
  }
  wake_();
}

JobProgress LoadJob::progress() const {
  return reporter_.progress();
}

std::optional<ScanPoints> LoadJob::take_points() {
  const std::lock_guard lock(mutex_);
  return std::exchange(points_, std::nullopt);
}

std::vector<std::string> LoadJob::take_notes() {
  return reporter_.take_notes();
}

std::optional<Result<LoadedScene>> LoadJob::take_scene() {
  const std::lock_guard lock(mutex_);
  return std::exchange(scene_, std::nullopt);
}

}  // namespace relief
