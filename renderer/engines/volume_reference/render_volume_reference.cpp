#include "renderer/engines/volume_reference/render_volume_reference.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include "common/median.h"
#include "renderer/engines/volume_reference/tiled_image.h"
#include "renderer/frame/film.h"
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

class Prepared final : public PreparedModel {
 public:
  Prepared(VolumeModel model, std::shared_ptr<EnvironmentCache> environments)
      : model_(std::move(model)), environments_(std::move(environments)) {}

  Result<RenderResult> render(const RenderSettings& settings, Progress& progress) override {
    RELIEF_TRY_ASSIGN(const KernelCloud* const cloud, model_.kernels(settings, progress));
    RELIEF_TRY_ASSIGN(const auto surroundings, surroundings_of(settings, *environments_));
    const View view = volume_view(settings);
    Drawn drawn;
    std::vector<double> frame_ms;
    for (int i = 0; i < std::max(settings.frames, 1); ++i) {
      const auto start = Clock::now();
      RELIEF_TRY_ASSIGN(drawn, draw(*cloud, view, settings, progress));
      if (progress.cancelled()) return interrupted_error();
      frame_ms.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
    RenderResult result;
    result.renderer = "CPU";
    result.fragments = drawn.evaluations;
    result.frame_ms = median_of(std::move(frame_ms));
    result.image = develop(drawn.film, surroundings, view, settings.outputs, result.covered_pixels);
    return result;
  }

 private:
  /// Figure 11 of [Zwicker 2002], with the visibility that the settings choose.
  Result<Drawn> draw(const KernelCloud& cloud, const View& view, const RenderSettings& settings,
                     const Progress& progress) const {
    const VolumeSettings& chosen = settings.volume;
    const FootprintRule rule = footprint_rule(chosen, cloud.weight, model_.is_antialiased(), view);
    RELIEF_TRY_ASSIGN(const KernelColour colour,
                      model_.colour_of(cloud, settings, view, *environments_));
    const Placement placement{cloud, view, rule, colour};
    TiledImage image(view.width, view.height,
                     {.compositing = composite_rule(chosen, cloud.weight),
                      .normals = settings.outputs.normal ? std::span(cloud.normals)
                                                         : std::span<const glm::vec3>(),
                      .has_depth = settings.outputs.depth,
                      .is_encoded = model_.blends_encoded(settings)});
    const VolumeVisibility visibility = visibility_of(cloud, chosen.visibility);
    if (visibility == VolumeVisibility::ImageSheet) {
      image.put_behind(place_slabs(placement, model_.spacing(), progress), progress);
    } else {
      const KernelOrder order = visibility == VolumeVisibility::Sheet
                                    ? order_by_sheets(cloud, ray_camera(view))
                                    : order_by_depth(cloud, ray_camera(view));
      draw_in_batches(placement, order, image, progress);
    }
    return Drawn{image.take_film(), image.evaluations()};
  }

  VolumeModel model_;
  std::shared_ptr<EnvironmentCache> environments_;
};

}  // namespace

Result<std::unique_ptr<PreparedModel>> prepare(const PrepareRequest& request) {
  return std::unique_ptr<PreparedModel>(
      std::make_unique<Prepared>(VolumeModel(request.model), request.environments));
}

}  // namespace relief::volume_reference
