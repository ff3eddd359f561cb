#include "renderer/engines/volume_reference/render_volume_reference.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "common/median.h"
#include "renderer/engines/volume_reference/tiled_image.h"
#include "renderer/frame/targets/film.h"
#include "renderer/volume/surfaces_beside.h"
#include "renderer/volume/volume_model.h"

namespace relief::volume_reference {
namespace {

using Clock = std::chrono::steady_clock;

/// Kernels that are placed before what they hide is known: enough work for many threads, few enough
/// that what lies behind an opaque layer is soon left out.
constexpr std::size_t kBatch = 65536;

struct Drawn {
  Film film;
  std::uint64_t evaluations = 0;
};

/// Front to back, until nothing more is seen.
void draw_in_batches(const Placement& placement, const KernelOrder& order, TiledImage& image,
                     const Progress& progress) {
  const auto is_hidden = [&](const Footprint& footprint) { return image.is_hidden(footprint); };
  for (std::size_t first = 0; first < order.groups() && !progress.cancelled();) {
    std::size_t end = first + 1;
    while (end < order.groups() && order.starts[end] - order.starts[first] < kBatch) ++end;
    image.put_behind(place_groups(placement, order, first, end, is_hidden, progress), progress);
    if (image.is_all_done()) return;
    first = end;
  }
}

/// Figure 11 of [Zwicker 2002], with the visibility that the settings choose.
Drawn draw_kernels(const Placement& placement, const VolumeModel& model,
                   const RenderSettings& settings, std::span<const float> limits,
                   const Progress& progress) {
  const KernelCloud& cloud = placement.cloud;
  const View& view = placement.view;
  const bool has_normal = settings.outputs.normal;
  TiledImage image(view.width, view.height,
                   {.compositing = composite_rule(settings.volume, cloud.weight),
                    .normals = has_normal ? std::span(cloud.normals) : std::span<glm::vec3>(),
                    .has_depth = settings.outputs.depth,
                    .limits = limits,
                    .is_encoded = model.blends_encoded(settings)});
  const VolumeVisibility visibility = visibility_of(cloud, settings.volume.visibility);
  if (visibility == VolumeVisibility::ImageSheet) {
    image.put_behind(place_slabs(placement, model.spacing(), progress), progress);
  } else {
    const KernelOrder order = visibility == VolumeVisibility::Sheet
                                  ? order_by_sheets(cloud, ray_camera(view))
                                  : order_by_depth(cloud, ray_camera(view));
    draw_in_batches(placement, order, image, progress);
  }
  Drawn drawn;
  drawn.film = image.take_film();
  drawn.evaluations = image.evaluations();
  return drawn;
}

class Prepared final : public PreparedModel {
 public:
  Prepared(VolumeModel model, std::shared_ptr<EnvironmentCache> environments,
           std::optional<SurfacesBeside> surfaces)
      : model_(std::move(model)),
        environments_(std::move(environments)),
        surfaces_(std::move(surfaces)) {}

  Result<RenderResult> render(const RenderSettings& asked, Progress& progress) override {
    const RenderSettings settings = model_.settled(asked);
    SurfacesBeside::Drawn surfaces;
    if (surfaces_) {
      RELIEF_TRY_ASSIGN(surfaces, surfaces_->draw(settings, progress));
    }
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, progress));
    RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, *environments_));
    const View view = volume_view(settings);
    Drawn drawn;
    std::vector<double> frame_ms;
    for (int i = 0; i < std::max(settings.frames, 1); ++i) {
      const auto start = Clock::now();
      RELIEF_TRY_ASSIGN(drawn, draw(*cloud, view, settings, surfaces, progress));
      if (progress.cancelled()) return interrupted_error();
      frame_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    RenderResult result;
    result.renderer = "CPU";
    result.fragments = drawn.evaluations;
    result.frame_ms = median_of(std::move(frame_ms)) + surfaces.frame_ms;
    drawn.film.blends_encoded = !surfaces_ && model_.blends_encoded(settings);
    result.image = develop(drawn.film, surroundings, view, settings.outputs, result.covered_pixels);
    return result;
  }

 private:
  Result<Drawn> draw(const KernelCloud& cloud, const View& view, const RenderSettings& settings,
                     const SurfacesBeside::Drawn& surfaces, const Progress& progress) const {
    const std::vector<FootprintRule> rules = model_.footprint_rules(settings, view);
    RELIEF_TRY_ASSIGN(const KernelColour colour,
                      model_.colour_of(cloud, settings, view, *environments_));
    const Placement placement{cloud, view, rules, colour};
    const auto draw_within = [&](std::span<const float> limits) {
      return draw_kernels(placement, model_, settings, limits, progress);
    };
    Drawn drawn = draw_within(surfaces.limits.covered);
    if (surfaces.film.pixels.empty()) return drawn;
    Drawn beside;
    if (!surfaces.limits.beside.empty()) beside = draw_within(surfaces.limits.beside);
    drawn.film = laid_over(surfaces.film, drawn.film, beside.film);
    drawn.evaluations += beside.evaluations;
    return drawn;
  }

  VolumeModel model_;
  std::shared_ptr<EnvironmentCache> environments_;
  std::optional<SurfacesBeside> surfaces_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  std::optional<SurfacesBeside> surfaces;
  if (has_surfaces(request.model)) {
    RELIEF_TRY_ASSIGN(surfaces, SurfacesBeside::prepare(request));
  }
  return std::unique_ptr<PreparedModel>(std::make_unique<Prepared>(
      VolumeModel(request.model), request.environments, std::move(surfaces)));
}

}  // namespace relief::volume_reference
