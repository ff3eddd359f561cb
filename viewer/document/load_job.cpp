#include "viewer/document/load_job.h"

#include <utility>

#include "loader/stream/tile_source.h"

namespace relief {

/// What the loading thread reports and the window's thread reads.
class LoadJob::Reporter final : public Progress {
 public:
  void begin_stage(std::string_view name, std::uint64_t units) override {
    const std::lock_guard lock(mutex_);
    stage_ = name;
    units_ = units;
    done_ = 0;
  }
  void advance(std::uint64_t units) override { done_ += units; }
  void note(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    notes_.emplace_back(text);
  }
  [[nodiscard]] bool cancelled() const override { return cancelled_; }

  void cancel() { cancelled_ = true; }
  [[nodiscard]] LoadProgress progress() const {
    const std::lock_guard lock(mutex_);
    LoadProgress progress{stage_, {}};
    if (units_ > 0)
      progress.share =
          std::min(1.0, static_cast<double>(done_.load()) / static_cast<double>(units_));
    return progress;
  }
  [[nodiscard]] std::vector<std::string> take_notes() {
    const std::lock_guard lock(mutex_);
    return std::exchange(notes_, {});
  }

 private:
  mutable std::mutex mutex_;
  std::string stage_;
  std::uint64_t units_ = 0;
  std::vector<std::string> notes_;
  std::atomic<std::uint64_t> done_ = 0;
  std::atomic<bool> cancelled_ = false;
};

LoadJob::LoadJob(LoadRequest request, std::function<void()> wake)
    : request_(std::move(request)),
      wake_(std::move(wake)),
      reporter_(std::make_unique<Reporter>()),
      thread_([this] { run(); }) {}

LoadJob::~LoadJob() {
  reporter_->cancel();
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
      RELIEF_TRY_ASSIGN(std::optional<LoadedScene> tiles, load_tiles(request_.plan, options));
      if (tiles) return *std::move(tiles);
      return load_scene(request_.plan, options, *reporter_);
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

LoadProgress LoadJob::progress() const {
  return reporter_->progress();
}

std::optional<ScanPoints> LoadJob::take_points() {
  const std::lock_guard lock(mutex_);
  return std::exchange(points_, std::nullopt);
}

std::vector<std::string> LoadJob::take_notes() {
  return reporter_->take_notes();
}

std::optional<Result<LoadedScene>> LoadJob::take_scene() {
  const std::lock_guard lock(mutex_);
  return std::exchange(scene_, std::nullopt);
}

}  // namespace relief
