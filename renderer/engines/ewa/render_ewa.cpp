#include "renderer/engines/ewa/render_ewa.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "common/median.h"
#include "common/transform.h"
#include "renderer/clip/refitted_cloud.h"
#include "renderer/engines/ewa/splatting.h"
#include "renderer/frame/targets/film.h"
#include "renderer/geometry/splats_of_samples.h"
#include "renderer/owned_or_borrowed.h"
#include "renderer/shading/environment/environment_cache.h"
#include "renderer/view/view.h"

namespace relief::ewa {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// As for `onepass`, no surface that can be told apart from the eye is before this; and where all
/// radii are huge, nothing that the camera looks at.
double near_of(const SplatCloud& cloud, const Camera& camera) {
  double near = 1e-6 * glm::distance(camera.eye, camera.target);
  for (const double radius : cloud.radii) {
    if (radius > 0.0) near = std::min(near, 0.01 * radius);
  }
  return near;
}

/// What does not change from frame to frame.
struct Scene {
  View view;
  Lighting lighting;
  Surroundings surroundings;
};

Result<Scene> make_scene(const SplatCloud& finest, EnvironmentCache& environments,
                         const RenderSettings& settings) {
  Scene scene;
  scene.view =
      make_view(settings.camera, settings.width, settings.height, near_of(finest, settings.camera));
  RELIEF_TRY_ASSIGN(auto lighting, make_lighting(settings, scene.view, environments));
  scene.lighting = std::move(lighting);
  RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, environments));
  scene.surroundings = surroundings;
  return scene;
}

RenderResult result_of(const Splatted& splatted, const Scene& scene,
                       const RenderSettings& settings) {
  RenderResult result;
  result.renderer = "CPU";
  result.fragments = splatted.evaluations;
  result.image = develop(splatted.film, scene.surroundings, scene.view, settings.outputs,
                         result.covered_pixels);
  return result;
}

/// All points at once.
Result<RenderResult> render_whole(const SplatCloud& cloud, EnvironmentCache& environments,
                                  ClipCache& clips, const RenderSettings& settings,
                                  Progress& progress) {
  RELIEF_TRY_ASSIGN(const Scene scene, make_scene(cloud, environments, settings));
  RELIEF_TRY_ASSIGN(const Clipping clipping, clips.get(cloud, 0, settings, progress));
  Splatted splatted;
  std::vector<double> frame_ms;
  for (int i = 0; i < std::max(settings.frames, 1); ++i) {
    if (progress.cancelled()) return interrupted_error();
    const auto start = Clock::now();
    splatted = splat_cloud(cloud, scene.view, settings.ewa, scene.lighting, progress, clipping);
    frame_ms.push_back(milliseconds_since(start));
  }
  if (progress.cancelled()) return interrupted_error();
  RenderResult result = result_of(splatted, scene, settings);
  result.frame_ms = median_of(std::move(frame_ms));
  return result;
}

/// The ends of the instances' samples, in the order of their splats.
std::vector<std::size_t> body_ends_of(const PatchModel& model) {
  std::vector<std::size_t> ends;
  std::size_t samples = 0;
  for (const Instance& instance : model.instances) {
    for (std::uint32_t k = 0; k < instance.count; ++k)
      samples += count_samples(model.patches[instance.first + k]);
    ends.push_back(samples);
  }
  return ends;
}

class Prepared final : public PreparedModel {
 public:
  template <class Cloud>
  Prepared(Cloud&& cloud, std::vector<std::size_t> body_ends,
           std::shared_ptr<EnvironmentCache> environments)
      : cloud_(std::forward<Cloud>(cloud)),
        drawn_(*cloud_),
        clips_(std::move(body_ends)),
        environments_(std::move(environments)) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& progress) override {
    RELIEF_TRY_ASSIGN(const SplatCloud* const cloud, drawn_.get(settings.clip, progress));
    if (settings.ewa.time_budget_ms <= 0.0)
      return render_whole(*cloud, *environments_, clips_, settings, progress);
    if (!hierarchy_ || hierarchy_of_ != cloud) {
      hierarchy_ = build_hierarchy(*cloud);
      hierarchy_of_ = cloud;
    }
    return render_progressive(
        *hierarchy_, *environments_, clips_, settings, [](const RenderResult&) {}, progress);
  }

 private:
  OwnedOrBorrowed<SplatCloud> cloud_;
  RefittedCloud drawn_;
  std::optional<SplatHierarchy> hierarchy_;
  const SplatCloud* hierarchy_of_ = nullptr;
  ClipCache clips_;
  std::shared_ptr<EnvironmentCache> environments_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  if (const auto* const cloud = request.model.find<SplatCloud>())
    return std::unique_ptr<PreparedModel>(
        std::make_unique<Prepared>(*cloud, std::vector<std::size_t>(), request.environments));
  const auto* const patches = request.model.find<PatchModel>();
  assert(patches != nullptr && "there are points, or patches");
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(
      patches->instances.empty() ? splats_of_samples(*patches) : splats_of_samples(bake(*patches)),
      body_ends_of(*patches), request.environments));
}

Result<RenderResult> render_progressive(const SplatHierarchy& hierarchy,
                                        EnvironmentCache& environments, ClipCache& clips,
                                        const RenderSettings& settings, const ShowImage& show,
                                        Progress& progress) {
  RELIEF_TRY_ASSIGN(const Scene scene,
                    make_scene(hierarchy.levels.front(), environments, settings));
  const std::size_t first = level_of_size(hierarchy, scene.view, kCoarsestPixels);
  const std::size_t last = level_of_size(hierarchy, scene.view, kFinestPixels);
  for (std::size_t level = last; level <= first; ++level)
    RELIEF_TRY(clips.get(hierarchy.levels[level], level, settings, progress));
  const auto start = Clock::now();
  for (std::size_t level = first;; --level) {
    const SplatCloud& cloud = hierarchy.levels[level];
    RELIEF_TRY_ASSIGN(const Clipping clipping, clips.get(cloud, level, settings, progress));
    const auto level_start = Clock::now();
    const Splatted splatted =
        splat_cloud(cloud, scene.view, settings.ewa, scene.lighting, progress, clipping);
    const double took = milliseconds_since(level_start);
    if (progress.cancelled()) return interrupted_error();
    RenderResult result = result_of(splatted, scene, settings);
    result.frame_ms = took;
    result.level = static_cast<std::uint32_t>(level);
    show(result);
    if (level == last) return result;
    const double growth = static_cast<double>(hierarchy.levels[level - 1].positions.size()) /
                          static_cast<double>(std::max<std::size_t>(cloud.positions.size(), 1));
    if (milliseconds_since(start) + growth * took > settings.ewa.time_budget_ms) return result;
  }
}

}  // namespace relief::ewa
