#include "viewer/drawing/truth_tracer.h"

#include <algorithm>
#include <atomic>
#include <new>
#include <utility>

#include "common/patch_file/patch_file.h"
#include "preprocess/raster/raster.h"
#include "renderer/engine_registry.h"
#include "renderer/shading/environment/environment_cache.h"

namespace relief {

/// Progress of one request: the tracer's thread reports, the window's reads and cancels.
class TruthTracer::Reporter final : public Progress {
 public:
  void begin_stage(std::string_view /*name*/, std::uint64_t units) override {
    units_ = units;
    done_ = 0;
  }
  void advance(std::uint64_t units) override { done_ += units; }
  [[nodiscard]] bool cancelled() const override { return cancelled_; }

  void cancel() { cancelled_ = true; }
  [[nodiscard]] double share() const {
    const std::uint64_t units = units_;
    return units > 0 ? std::min(1.0, double(done_.load()) / double(units)) : 0.0;
  }

 private:
  std::atomic<std::uint64_t> units_ = 0;
  std::atomic<std::uint64_t> done_ = 0;
  std::atomic<bool> cancelled_ = false;
};

namespace {

/// Whether the faces of all files can be read again: those of patch files are gone.
bool has_input_faces(const TruthModel& model) {
  return model.scene->has_faces && !model.scene->colours &&
         std::none_of(model.plan.models.begin(), model.plan.models.end(), [&](const SceneModel& m) {
           return names_patch_file(m.file) || is_raster(m.file, model.options.read.format);
         });
}

/// What the tracer's thread keeps from request to request.
struct Triangles {
  std::optional<LoadedScene> input;
  std::unique_ptr<PreparedModel> prepared;
};

Status prepare(const TruthModel& model, std::span<const RenderSettings> views, Progress& progress,
               Triangles& triangles) {
  if (has_input_faces(model)) {
    LoadOptions options = model.options;
    options.on_points = {};
    RELIEF_TRY_ASSIGN(triangles.input,
                      load_models(model.plan.models, options, {.mesh = true}, progress));
  }
  const bool is_input = triangles.input && triangles.input->mesh;
  const RenderModel form =
      is_input ? RenderModel::of(*triangles.input->mesh) : RenderModel::of(model.scene->patches);
  RELIEF_TRY_ASSIGN(const EngineEntry* const engine, engine_named("raytrace", engines()));
  RELIEF_TRY_ASSIGN(triangles.prepared,
                    engine->prepare({.model = form,
                                     .views = views,
                                     .opengl = nullptr,
                                     .environments = std::make_shared<EnvironmentCache>()}));
  return {};
}

Result<Truth> trace(const TruthModel& model, std::span<const RenderSettings> views,
                    Progress& progress, Triangles& triangles) {
  if (triangles.prepared == nullptr) {
    RELIEF_TRY(prepare(model, views, progress, triangles));
  }
  Truth truth;
  truth.is_input = triangles.input.has_value();
  for (const RenderSettings& view : views) {
    RELIEF_TRY_ASSIGN(RenderResult result, triangles.prepared->render(view, progress));
    truth.images.push_back(std::move(result.image));
  }
  return truth;
}

}  // namespace

TruthTracer::TruthTracer(TruthModel model, std::function<void()> wake)
    : model_(std::move(model)), wake_(std::move(wake)), thread_([this] { run(); }) {}

TruthTracer::~TruthTracer() {
  cancel();
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  asked_.notify_one();
}

void TruthTracer::begin(std::vector<RenderSettings> views) {
  cancel();
  {
    const std::lock_guard lock(mutex_);
    views_ = std::move(views);
  }
  asked_.notify_one();
}

void TruthTracer::cancel() {
  const std::lock_guard lock(mutex_);
  views_.clear();
  if (reporter_ != nullptr) reporter_->cancel();
  done_.reset();
}

std::optional<Result<Truth>> TruthTracer::take() {
  const std::lock_guard lock(mutex_);
  return std::exchange(done_, std::nullopt);
}

double TruthTracer::share() const {
  const std::lock_guard lock(mutex_);
  return reporter_ == nullptr ? 0.0 : reporter_->share();
}

void TruthTracer::run() {
  Triangles triangles;
  while (true) {
    std::vector<RenderSettings> views;
    const auto reporter = std::make_shared<Reporter>();
    {
      std::unique_lock lock(mutex_);
      asked_.wait(lock, [this] { return ends_ || !views_.empty(); });
      if (ends_) return;
      views = std::exchange(views_, {});
      reporter_ = reporter;
    }
    Result<Truth> truth = [&]() -> Result<Truth> {
      try {
        return trace(model_, views, *reporter, triangles);
      } catch (const std::bad_alloc&) {
        return make_error("there is not enough memory to trace this model");
      }
    }();
    {
      const std::lock_guard lock(mutex_);
      if (reporter->cancelled()) continue;
      done_ = std::move(truth);
    }
    wake_();
  }
}

RenderSettings truth_of(RenderSettings look) {
  look.engine = "raytrace";
  look.eye_dome = 0.0;
  look.outputs = {};
  look.frames = 0;
  look.count_fragments = false;
  return look;
}

}  // namespace relief
