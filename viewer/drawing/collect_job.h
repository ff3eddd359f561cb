// What is uploaded of a scene, collected in the background.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <stop_token>
#include <thread>
#include <vector>

#include "loader/load_scene.h"
#include "renderer/settings.h"
#include "renderer/store/collected_store.h"

namespace relief {

/// Fewer samples than these are uploaded at once, which takes 0.15 s of 60,000 at the Dragon's
/// rate.
inline constexpr std::uint64_t kQuickSamples = 60'000;

/// Whether uploading a scene takes so long that the window is to show something else meanwhile. Not
/// of one whose patches are read as views need them.
[[nodiscard]] bool is_slow_to_collect(const LoadedScene& scene);

/// Collects on a thread of its own while the window goes on.
class CollectJob {
 public:
  /// `looks`: what will be uploaded for. `wake`: called on that thread when it is done.
  CollectJob(std::shared_ptr<const LoadedScene> scene, std::vector<RenderSettings> looks,
             const StoreLimits& limits, std::function<void()> wake);

  [[nodiscard]] bool is_done() const { return is_done_; }
  [[nodiscard]] const std::shared_ptr<const LoadedScene>& scene() const { return scene_; }
  [[nodiscard]] const std::vector<RenderSettings>& looks() const { return looks_; }

  /// What was collected, once it is done. Null if it failed: uploading will say why.
  [[nodiscard]] CollectedStore* collected() const { return made_.get(); }

 private:
  void run(const std::stop_token& stop);

  std::shared_ptr<const LoadedScene> scene_;
  RenderModel forms_;
  std::vector<RenderSettings> looks_;
  StoreLimits limits_;
  std::function<void()> wake_;
  std::unique_ptr<CollectedStore> made_;
  std::atomic<bool> is_done_ = false;
  std::jthread thread_;  ///< last: it uses all others
};

}  // namespace relief
