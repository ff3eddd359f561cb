#include "viewer/drawing/collect_job.h"

#include <new>
#include <utility>

#include "renderer/viewport.h"

namespace relief {

bool is_slow_to_collect(const LoadedScene& scene) {
  if (scene.tiles != nullptr || scene.has_kernels()) return false;
  return !scene.patches.instances.empty() || count_samples(scene.patches) >= kQuickSamples;
}

CollectJob::CollectJob(std::shared_ptr<const LoadedScene> scene, std::vector<RenderSettings> looks,
                       const StoreLimits& limits, std::function<void()> wake)
    : scene_(std::move(scene)),
      forms_(scene_->forms()),
      looks_(std::move(looks)),
      limits_(limits),
      wake_(std::move(wake)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

void CollectJob::run(const std::stop_token& stop) {
  try {
    auto made = collect_for_viewport(forms_, looks_, limits_, stop);
    if (made) made_ = *std::move(made);
  } catch (const std::bad_alloc&) {
    made_.reset();
  }
  is_done_ = true;
  wake_();
}

}  // namespace relief
